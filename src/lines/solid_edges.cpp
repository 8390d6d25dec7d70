#include "lines/solid_edges.h"

#include <algorithm>
#include <array>

#include "base/degrees.h"

namespace whittle {
namespace {

/// An edge, at the lower of its two corners.
struct Spoke {
  uint32_t high;  ///< the other corner
  uint32_t face;  ///< to the left of the edge as it runs up, seen from outside
};

/// The edges of triangles that run up from one corner to another, by the lower.
struct Spokes {
  std::vector<size_t> firsts;
  std::vector<Spoke> spokes;

  explicit Spokes(const SolidMesh& mesh) : firsts(mesh.corners.size() + 1, 0) {
    const auto for_all = [&](const auto& visit) {
      for (const SolidMesh::Triangle& triangle : mesh.triangles)
        for (size_t i = 0; i < 3; ++i)
          if (const uint32_t a = triangle.corners[i], b = triangle.corners[(i + 1) % 3]; a < b)
            visit(a, Spoke{b, triangle.face});
    };
    for_all([&](uint32_t low, const Spoke&) { ++firsts[low + 1]; });
    for (size_t i = 1; i < firsts.size(); ++i) firsts[i] += firsts[i - 1];
    spokes.resize(firsts.back());
    std::vector<size_t> next(firsts.begin(), firsts.end() - 1);
    for_all([&](uint32_t low, const Spoke& spoke) { spokes[next[low]++] = spoke; });
    for (size_t i = 0; i + 1 < firsts.size(); ++i)
      std::sort(spokes.begin() + std::ptrdiff_t(firsts[i]),
                spokes.begin() + std::ptrdiff_t(firsts[i + 1]),
                [](const Spoke& a, const Spoke& b) { return a.high < b.high; });
  }

  /// The face to the left of the edge from `low` to `high`.
  uint32_t face(uint32_t low, uint32_t high) const {
    const auto begin = spokes.begin() + std::ptrdiff_t(firsts[low]);
    const auto end = spokes.begin() + std::ptrdiff_t(firsts[low + 1]);
    return std::lower_bound(begin, end, high, [](const Spoke& a, uint32_t b) { return a.high < b; })
        ->face;
  }
};

double longest_edge(const SolidMesh& mesh, const SolidMesh::Triangle& triangle) {
  double longest = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 from = mesh.corners[triangle.corners[i]];
    longest = std::max(longest, length(mesh.corners[triangle.corners[(i + 1) % 3]] - from));
  }
  return longest;
}

/// A ball's facets are off by the fineness along both of its circles; and a little more, so as not
/// to ask for the edge itself.
constexpr double kStray = 3;

/// How each face looks to the eye: the cosine, 0 or less where it does not.
std::vector<double> facings(const SolidMesh& mesh, const ViewProjection& projection,
                            bool is_inside) {
  // What is seen along is not seen; rounding must not say otherwise.
  constexpr double kAlong = 1e-9;
  std::vector<double> result(mesh.faces.size(), 0);
  std::vector<bool> known(mesh.faces.size(), false);
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    if (known[triangle.face]) continue;
    known[triangle.face] = true;
    const double cosine =
        projection.facing(mesh.faces[triangle.face].outward, mesh.corners[triangle.corners[0]]);
    const double seen = is_inside ? -cosine : cosine;
    result[triangle.face] = seen > kAlong ? seen : 0;
  }
  return result;
}

/// What is asked of one edge after another.
class EdgeJudge {
 public:
  EdgeJudge(const SolidMesh& mesh, const TrueNormals& normals, const ViewProjection& projection,
            bool is_inside)
      : mesh_(mesh),
        normals_(normals),
        facings_(facings(mesh, projection, is_inside)),
        is_inside_(is_inside) {}

  /// Adds the edge if it is drawn. The faces: left and right of it, seen from outside.
  /// `longest`: the longest edge of the triangle to its right.
  void judge(Vec3 from, Vec3 to, uint32_t left, uint32_t right, double longest,
             std::vector<SolidEdge>& out) const {
    SolidEdge edge{.from = from, .to = to, .inward = {}};
    const bool sees_left = facings_[left] > 0, sees_right = facings_[right] > 0;
    edge.is_contour = sees_left != sees_right;
    const Vec3 middle = (from + to) / 2;
    const Vec3 true_left = normals_.at(mesh_.faces[left], middle),
               true_right = normals_.at(mesh_.faces[right], middle);
    const bool is_crease = dot(true_left, true_right) < most_cosine(left, right);
    if (!edge.is_contour && !is_crease) return;
    if (normals_.may_be_made(mesh_.faces[left]) || normals_.may_be_made(mesh_.faces[right])) {
      // Surfaces that meet at a small angle meet elsewhere if one of them is moved a little.
      constexpr double kLeastSine = 0.08;
      // What looks away from it is the other side of a crack.
      const bool is_crack = dot(true_left, true_right) < -0.99;
      const double sine = is_crease && !is_crack ? length(cross(true_left, true_right)) : 1;
      edge.doubt = Doubt::kMade;
      edge.stray = kStray / std::max(sine, kLeastSine);
    } else if (!is_crease && normals_.body(mesh_.faces[left]) != 0) {
      edge.doubt = Doubt::kFold;
      edge.stray = kStray / 2;
      edge.fold = 2 * longest;
    }
    const Vec3 way = normalize(to - from);
    const Vec3 n_left = mesh_.faces[left].outward, n_right = mesh_.faces[right].outward;
    const bool is_convex = (dot(cross(n_left, n_right), way) > 0) != is_inside_;
    edge.may_cover = edge.is_contour && is_convex;
    edge.may_be_seen = edge.is_contour ? is_convex : sees_left;
    if (edge.may_be_seen)
      edge.inward = facings_[left] >= facings_[right] ? cross(n_left, way) : cross(way, n_right);
    out.push_back(edge);
  }

 private:
  /// Normals with a larger one between them are of one surface.
  double most_cosine(uint32_t left, uint32_t right) const {
    const uint32_t body = normals_.body(mesh_.faces[left]);
    const bool is_one_body = body != 0 && body == normals_.body(mesh_.faces[right]);
    return cos_degrees(is_one_body ? kCreaseOfBody : kCrease);
  }

  const SolidMesh& mesh_;
  const TrueNormals& normals_;
  std::vector<double> facings_;
  bool is_inside_;
};

}  // namespace

std::vector<SolidEdge> solid_edges(const SolidMesh& mesh, const TrueNormals& normals,
                                   const ViewProjection& projection, bool is_inside,
                                   const Workers& workers) {
  const Spokes spokes(mesh);
  const EdgeJudge judge(mesh, normals, projection, is_inside);
  constexpr size_t kChunk = 4096;
  std::vector<std::vector<SolidEdge>> chunks((mesh.triangles.size() + kChunk - 1) / kChunk);
  workers.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t chunk = first; chunk < last; ++chunk) {
      const size_t end = std::min(mesh.triangles.size(), (chunk + 1) * kChunk);
      for (size_t t = chunk * kChunk; t < end; ++t) {
        const SolidMesh::Triangle& triangle = mesh.triangles[t];
        for (size_t i = 0; i < 3; ++i) {
          // Each edge once: where its triangle runs down it.
          const uint32_t high = triangle.corners[i], low = triangle.corners[(i + 1) % 3];
          if (high < low) continue;
          const uint32_t left = spokes.face(low, high);
          if (left != triangle.face)
            judge.judge(mesh.corners[low], mesh.corners[high], left, triangle.face,
                        longest_edge(mesh, triangle), chunks[chunk]);
        }
      }
    }
  });
  std::vector<SolidEdge> edges;
  for (const std::vector<SolidEdge>& chunk : chunks)
    edges.insert(edges.end(), chunk.begin(), chunk.end());
  return edges;
}

}  // namespace whittle

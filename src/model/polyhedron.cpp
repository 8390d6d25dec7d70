// Every plane is pushed out until it supports all corners, so the solid holds its own corners
// whatever their rounding. What rounding does to a plane's direction grows as the face gets
// narrower; the test for convexity allows for just that.
//
// Every plane is held against every corner, but a tree of them answers for most. Faces in one plane
// are found by going from neighbour to neighbour: what of a convex surface lies within a little of
// a plane that touches it hangs together.
#include "model/polyhedron.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/box.h"
#include "model/corner_tree.h"

namespace whittle {

namespace {

using Loop = std::vector<uint32_t>;

struct Face {
  uint32_t number;  ///< in the file, for messages
  Loop loop;        ///< corners, at least 3 different ones in a row
  Vec3 normal;      ///< unit
  double area = 0;
  double width = 0;  ///< how narrow the face is: area over its greatest reach
  Vec3 middle;
};

/// Corners by place: equal points get the number of the first of them.
std::vector<uint32_t> merge_equal_points(const std::vector<Vec3>& points) {
  std::map<std::tuple<double, double, double>, uint32_t> first;
  std::vector<uint32_t> merged(points.size());
  for (uint32_t i = 0; i < points.size(); ++i)
    merged[i] = first.try_emplace({points[i].x, points[i].y, points[i].z}, i).first->second;
  return merged;
}

Loop clean_loop(const Loop& face, const std::vector<uint32_t>& merged) {
  Loop loop;
  for (const uint32_t i : face)
    if (loop.empty() || loop.back() != merged[i]) loop.push_back(merged[i]);
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  return loop;
}

/// Twice the area as a vector (Newell), by fans about the first corner; inward for OpenSCAD's
/// order.
Vec3 area_vector(const Loop& loop, const std::vector<Vec3>& points) {
  Vec3 sum;
  const Vec3 o = points[loop[0]];
  for (size_t i = 2; i < loop.size(); ++i)
    sum += cross(points[loop[i - 1]] - o, points[loop[i]] - o);
  return sum;
}

/// Which face, by its place in the list, runs along an edge in that direction.
class Edges {
 public:
  /// False if a face does so already.
  bool add(uint32_t from, uint32_t to, uint32_t face) {
    return faces_.try_emplace(key(from, to), face).second;
  }
  const uint32_t* find(uint32_t from, uint32_t to) const {
    const auto found = faces_.find(key(from, to));
    return found == faces_.end() ? nullptr : &found->second;
  }

 private:
  static uint64_t key(uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; }
  std::unordered_map<uint64_t, uint32_t> faces_;
};

/// Calls `visit(from, to)` for every edge of the face; stops where it returns false.
template <class Visit>
bool all_edges(const Loop& loop, const Visit& visit) {
  uint32_t from = loop.back();
  for (const uint32_t to : loop) {
    if (!visit(from, to)) return false;
    from = to;
  }
  return true;
}

/// Each edge must be run along once in each direction.
std::optional<std::string> check_closed(const std::vector<Face>& faces, Edges& edges) {
  std::string reason;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const auto is_new = [&](uint32_t a, uint32_t b) {
      if (edges.add(a, b, f)) return true;
      reason = fmt::format(
          "its faces are not turned the same way, or cross: the edge from point {} to {} is run "
          "along twice, the second time by face {}",
          a, b, faces[f].number);
      return false;
    };
    if (!all_edges(faces[f].loop, is_new)) return reason;
  }
  for (const Face& face : faces) {
    const auto has_twin = [&](uint32_t a, uint32_t b) {
      if (edges.find(b, a) != nullptr) return true;
      reason = fmt::format("it is not closed: only face {} has the edge from point {} to {}",
                           face.number, a, b);
      return false;
    };
    if (!all_edges(face.loop, has_twin)) return reason;
  }
  return std::nullopt;
}

/// What the faces are, once the text's peculiarities are gone.
struct Surface {
  const std::vector<Vec3>& points;
  std::vector<Face> faces;
  std::vector<CornerTree::Corner> corners;  ///< points that faces use
  Edges edges;
  double size = 0;  ///< the diagonal of the box

  /// Else it is too narrow to have one; its neighbours bound the solid there.
  bool has_direction(const Face& face) const { return face.width > kFlatSolid * kFlatSolid * size; }
};

void measure(Face& face, const std::vector<Vec3>& points) {
  const Vec3 area = area_vector(face.loop, points);
  double reach = 0;
  for (const uint32_t i : face.loop) {
    face.middle += points[i] / double(face.loop.size());
    reach = std::max(reach, length(points[i] - points[face.loop[0]]));
  }
  face.area = length(area);
  face.width = face.area / reach;
  face.normal = -normalize(area);
}

/// Six times the volume; negative if the faces are turned inward. The centre, which may be any,
/// spares digits.
double volume(const Surface& surface, Vec3 center) {
  double sum = 0;
  for (const Face& face : surface.faces) sum += dot(face.middle - center, face.normal * face.area);
  return sum;
}

bool is_thin(const Surface& surface) {
  const Face& largest = *std::ranges::max_element(surface.faces, {}, &Face::area);
  const auto across = [&](const CornerTree::Corner& corner) {
    return dot(corner.place - largest.middle, largest.normal);
  };
  const auto [below, above] = std::ranges::minmax(surface.corners, {}, across);
  return !(across(above) - across(below) > kFlatSolid * surface.size);
}

CornerTree make_tree(Surface& surface) {
  std::vector<Vec3> outward(surface.points.size());
  for (const Face& face : surface.faces)
    for (const uint32_t i : face.loop) outward[i] += face.normal;
  for (CornerTree::Corner& corner : surface.corners) corner.normal = outward[corner.number];
  return CornerTree(std::move(surface.corners));
}

/// The plane of a face, pushed out to the farthest corner; or why that would be too far.
std::variant<Plane, std::string> supporting_plane(const Surface& surface, const Face& face,
                                                  const CornerTree& tree) {
  const double slack = kPolyhedronSlack * surface.size;
  const Vec3 n = face.normal;
  const double mean = dot(n, face.middle);
  double support = -kInfinity;
  for (const uint32_t i : face.loop) {
    const double height = dot(n, surface.points[i]);
    if (std::fabs(height - mean) > slack)
      return fmt::format("face {} is not flat: point {} lies {:.3g} off it", face.number, i,
                         std::fabs(height - mean));
    support = std::max(support, height);
  }
  const auto forgiven = [&](double distance) { return slack * (1 + distance / face.width); };
  std::string reason;
  tree.search(
      n, face.middle,
      [&](double height, double distance) {
        return reason.empty() && (height > support || height - mean > forgiven(distance));
      },
      [&](const CornerTree::Corner& corner) {
        const double height = dot(n, corner.place), beyond = height - mean;
        support = std::max(support, height);
        if (beyond > forgiven(length(corner.place - face.middle)))
          reason = fmt::format("it is not convex: point {} lies {:.3g} outside face {}",
                               corner.number, beyond, face.number);
      });
  if (!reason.empty()) return reason;
  return Plane{n, support};
}

/// Marks the face and all that hang together with it in its plane.
void mark_plane(const Surface& surface, const Plane& plane, uint32_t seed,
                std::vector<bool>& has_plane) {
  const auto is_in_plane = [&](const Face& face) {
    if (surface.has_direction(face) && !(dot(plane.n, face.normal) > 0)) return false;
    return std::ranges::all_of(face.loop, [&](uint32_t i) {
      return std::fabs(dot(plane.n, surface.points[i]) - plane.d) <= kSamePlane * surface.size;
    });
  };
  has_plane[seed] = true;
  std::vector<uint32_t> open{seed};
  while (!open.empty()) {
    const uint32_t face = open.back();
    open.pop_back();
    all_edges(surface.faces[face].loop, [&](uint32_t a, uint32_t b) {
      const uint32_t neighbour = *surface.edges.find(b, a);
      if (!has_plane[neighbour] && is_in_plane(surface.faces[neighbour])) {
        has_plane[neighbour] = true;
        open.push_back(neighbour);
      }
      return true;
    });
  }
}

}  // namespace

std::optional<std::string> build_planes(Polyhedron& polyhedron) {
  polyhedron.planes.clear();
  Surface surface{.points = polyhedron.points, .faces = {}, .corners = {}, .edges = {}};
  const std::vector<Vec3>& points = surface.points;

  const std::vector<uint32_t> merged = merge_equal_points(points);
  std::vector<bool> used(points.size());
  Box box;
  bool all_finite = true;
  for (uint32_t f = 0; f < polyhedron.faces.size(); ++f) {
    const Loop& given = polyhedron.faces[f];
    if (given.size() < 3) continue;
    for (const uint32_t i : given)
      if (i >= points.size())
        return fmt::format("face {} uses point {}, but the points are 0 to {}", f, i,
                           int64_t(points.size()) - 1);
    Face face{.number = f, .loop = clean_loop(given, merged), .normal = {}, .middle = {}};
    if (face.loop.size() < 3) continue;
    for (const uint32_t i : face.loop) {
      all_finite = all_finite && is_finite(points[i]);
      if (used[i]) continue;
      used[i] = true;
      surface.corners.push_back({.place = points[i], .normal = {}, .number = i});
      box.include(points[i]);
    }
    surface.faces.push_back(std::move(face));
  }
  std::vector<Face>& faces = surface.faces;
  const double size = surface.size = box.diagonal();
  if (!all_finite || faces.empty() || !(size > 0) || !std::isfinite(size * size * size)) return {};
  for (Face& face : faces) measure(face, points);
  if (is_thin(surface)) return {};
  if (auto reason = check_closed(faces, surface.edges)) return reason;
  if (volume(surface, box.center()) < 0)
    for (Face& face : faces) face.normal = -face.normal;

  // Widest first: the direction of a sliver is the least certain, so that a sliver in the plane of
  // a larger face goes with it.
  std::vector<uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](uint32_t f) { return faces[f].width; });
  const CornerTree tree = make_tree(surface);
  std::vector<Plane> planes;
  std::vector<bool> has_plane(faces.size());
  for (const uint32_t f : order) {
    if (has_plane[f] || !surface.has_direction(faces[f])) continue;
    std::variant<Plane, std::string> plane = supporting_plane(surface, faces[f], tree);
    if (auto* const reason = std::get_if<std::string>(&plane)) return std::move(*reason);
    planes.push_back(std::get<Plane>(plane));
    mark_plane(surface, planes.back(), f, has_plane);
  }
  polyhedron.planes = std::move(planes);
  return std::nullopt;
}

}  // namespace whittle

#include "evaluate/minkowski.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/workers.h"
#include "evaluate/convex_hull.h"
#include "evaluate/convex_pieces.h"

namespace whittle {
namespace {

/// For each of so many corners some vectors.
class VectorsOfCorners {
 public:
  VectorsOfCorners() = default;
  VectorsOfCorners(size_t corners, std::vector<std::pair<uint32_t, Vec3>> all)
      : first_(corners + 1) {
    for (const auto& [corner, vector] : all) ++first_[corner + 1];
    for (size_t i = 0; i < corners; ++i) first_[i + 1] += first_[i];
    vectors_.resize(all.size());
    std::vector<uint32_t> next = first_;
    for (const auto& [corner, vector] : all) vectors_[next[corner]++] = vector;
  }

  bool is_empty() const { return vectors_.empty(); }
  std::span<const Vec3> of(size_t corner) const {
    return std::span(vectors_).subspan(first_[corner], first_[corner + 1] - first_[corner]);
  }

 private:
  std::vector<uint32_t> first_;
  std::vector<Vec3> vectors_;
};

/// A convex body, or a convex piece of a plane.
struct Convex {
  std::vector<Vec3> points;
  VectorsOfCorners ways;     ///< unit, from each corner along the edges there
  VectorsOfCorners normals;  ///< of the faces there, outward; none of a piece of a plane
};

using Ways = std::vector<std::pair<uint32_t, Vec3>>;

void add_edge(std::span<const Vec3> points, uint32_t from, uint32_t to, Ways& ways) {
  ways.emplace_back(from, normalize(points[to] - points[from]));
}

Convex convex_of(const Polyhedron& solid) {
  Convex convex;
  convex.points = solid.points;
  Ways ways, normals;
  for (const std::vector<uint32_t>& face : solid.faces) {
    Vec3 inward;
    const Vec3 o = solid.points[face[0]];
    for (size_t k = 2; k < face.size(); ++k)
      inward += cross(solid.points[face[k - 1]] - o, solid.points[face[k]] - o);
    const Vec3 outward = -normalize(inward);
    for (size_t k = 0; k < face.size(); ++k) {
      add_edge(solid.points, face[k], face[(k + 1) % face.size()], ways);
      normals.emplace_back(face[k], outward);
    }
  }
  convex.ways = VectorsOfCorners(solid.points.size(), std::move(ways));
  convex.normals = VectorsOfCorners(solid.points.size(), std::move(normals));
  return convex;
}

Convex convex_of(std::span<const Vec3> points, const std::vector<uint32_t>& piece) {
  Convex convex;
  for (const uint32_t i : piece) convex.points.push_back(points[i]);
  Ways ways;
  const auto n = uint32_t(piece.size());
  for (uint32_t k = 0; k < n; ++k) {
    add_edge(convex.points, k, (k + 1) % n, ways);
    add_edge(convex.points, k, (k + n - 1) % n, ways);
  }
  convex.ways = VectorsOfCorners(n, std::move(ways));
  return convex;
}

/// Points whose hull is the sum. A sum of two corners can only be a corner if there is a direction
/// in which both are the farthest: one among those between the normals at b's corner that has no
/// part along any way from a's. So it is not needed where for one of these ways all normals point
/// along it.
std::vector<Vec3> sums_of_corners(const Convex& a, const Convex& b) {
  // What rounding may do to the directions of small edges and faces; more corners do no harm.
  constexpr double kSlack = 1e-6;
  std::vector<Vec3> sums;
  for (size_t i = 0; i < a.points.size(); ++i) {
    for (size_t k = 0; k < b.points.size(); ++k) {
      const auto leads_on = [&](Vec3 way) {
        const std::span<const Vec3> normals = b.normals.of(k);
        return std::all_of(normals.begin(), normals.end(),
                           [&](Vec3 normal) { return dot(normal, way) > kSlack; });
      };
      const std::span<const Vec3> ways = a.ways.of(i);
      if (b.normals.is_empty() || std::none_of(ways.begin(), ways.end(), leads_on))
        sums.push_back(a.points[i] + b.points[k]);
    }
  }
  return sums;
}

std::optional<Polyhedron> sum_of(const Convex& a, const Convex& b) {
  return solid_hull(b.normals.is_empty() ? sums_of_corners(b, a) : sums_of_corners(a, b));
}

/// A part of an operand.
struct Term {
  std::optional<Polyhedron> solid = {};  ///< if it is convex
  SolidPart surface = {};                ///< if it is not
};

/// None of what has no volume.
std::optional<Term> term_of(SolidPart part) {
  if (!part.is_convex()) return Term{.surface = std::move(part)};
  std::optional<Polyhedron> solid = solid_hull(part.points);
  if (!solid) return std::nullopt;
  return Term{.solid = std::move(solid)};
}

/// What of it is added to what of others: itself, if it is convex; else its facets.
std::vector<Convex> pieces_of(const Term& term) {
  if (term.solid) return {convex_of(*term.solid)};
  std::vector<Convex> pieces;
  for (const std::vector<uint32_t>& piece :
       convex_pieces(term.surface.points, term.surface.triangles))
    pieces.push_back(convex_of(term.surface.points, piece));
  return pieces;
}

std::vector<std::vector<Convex>> pieces_of(const std::vector<Term>& terms) {
  std::vector<std::vector<Convex>> pieces;
  for (const Term& term : terms) pieces.push_back(pieces_of(term));
  return pieces;
}

/// A point in it.
Vec3 middle_of(const Polyhedron& solid) {
  Vec3 sum;
  for (const Vec3 p : solid.points) sum += p;
  return sum / double(solid.points.size());
}

/// Points of what is to be added to others: one for each part that hangs together, or more.
std::vector<Vec3> points_of(const Term& term) {
  if (term.solid) return {middle_of(*term.solid)};
  const Shells shells = shells_of(term.surface);
  std::vector<Vec3> points(shells.count);
  for (size_t i = 0; i < shells.of_point.size(); ++i)
    if (shells.of_point[i] < shells.count) points[shells.of_point[i]] = term.surface.points[i];
  return points;
}

/// The sums of two operands' parts.
class Sum {
 public:
  Sum(int threads, Budget& budget) : threads_(threads), budget_(budget) {}

  std::vector<Term> operator()(const std::vector<Term>& a, const std::vector<Term>& b) {
    std::vector<Term> sums;
    const std::vector<std::vector<Convex>> of_a = pieces_of(a), of_b = pieces_of(b);
    std::vector<Pair> pairs;
    for (size_t i = 0; i < a.size(); ++i) {
      for (size_t k = 0; k < b.size(); ++k) {
        add_moved(a[i], b[k], sums);
        add_moved(b[k], a[i], sums);
        for (const Convex& s : of_a[i]) {
          for (const Convex& t : of_b[k]) {
            // A hull takes more than the pairs of its corners.
            constexpr uint64_t kPerHull = 1000;
            const uint64_t corners = uint64_t(s.points.size()) * t.points.size();
            if (!budget_.work(kPerHull + corners)) return {};
            pairs.push_back({&s, &t});
          }
        }
      }
    }
    add_hulls(pairs, sums);
    return sums;
  }

 private:
  struct Pair {
    const Convex *a, *b;
  };

  /// `a`, if it is not convex, moved by points of `b`.
  void add_moved(const Term& a, const Term& b, std::vector<Term>& sums) {
    if (a.solid) return;
    for (const Vec3 by : points_of(b)) {
      if (!budget_.spend(a.surface.triangles.size())) return;
      sums.push_back(a);
      transform(translation(by), sums.back().surface);
    }
  }

  /// Some at a time, so that no more is made than may be.
  void add_hulls(const std::vector<Pair>& pairs, std::vector<Term>& sums) {
    constexpr size_t kAtOnce = 1024, kWorthThreads = 64;
    std::vector<std::optional<Polyhedron>> hulls;
    for (size_t first = 0; first < pairs.size(); first += kAtOnce) {
      const size_t count = std::min(kAtOnce, pairs.size() - first);
      hulls.assign(count, std::nullopt);
      if (!workers_ && count >= kWorthThreads && threads_ != 1)
        workers_ = std::make_unique<Workers>(threads_);
      for_parts(workers_.get(), count, 1, [&](size_t begin, size_t end, size_t) {
        for (size_t i = begin; i < end; ++i)
          hulls[i] = sum_of(*pairs[first + i].a, *pairs[first + i].b);
      });
      for (std::optional<Polyhedron>& hull : hulls) {
        if (!hull) continue;
        if (!budget_.spend(hull->faces.size())) return;
        sums.push_back({.solid = std::move(hull)});
      }
    }
  }

  int threads_;
  Budget& budget_;
  std::unique_ptr<Workers> workers_;
};

/// From the numbers of facets to planes.
std::shared_ptr<const TriangleMesh> mesh_of(SolidPart part) {
  TriangleMesh mesh;
  mesh.points = std::move(part.points);
  mesh.triangles = std::move(part.triangles);
  std::vector<size_t> corners;
  const auto at = [&](const TriangleMesh::Triangle& t, size_t k) {
    return mesh.points[t.corners[k]];
  };
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    if (t.facet >= mesh.facets.size()) mesh.facets.resize(t.facet + 1), corners.resize(t.facet + 1);
    mesh.facets[t.facet].n += cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0));
    corners[t.facet] += 3;
  }
  for (Plane& plane : mesh.facets) {
    plane.n = normalize(plane.n);
    if (plane.n == Vec3{}) plane.n = {0, 0, 1};
  }
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      mesh.facets[t.facet].d += dot(mesh.facets[t.facet].n, at(t, k)) / double(corners[t.facet]);
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Plane& plane = mesh.facets[t.facet];
    for (size_t k = 0; k < 3; ++k)
      mesh.rise = std::fmax(mesh.rise, std::fabs(dot(plane.n, at(t, k)) - plane.d));
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace

std::vector<Shape> minkowski_sum(std::vector<SolidPart> parts, int threads, Budget& budget) {
  std::vector<std::vector<Term>> operands;
  std::erase_if(parts, [](const SolidPart& part) { return part.points.empty(); });
  for (size_t i = 0; i < parts.size();) {
    std::vector<Term>& operand = operands.emplace_back();
    const uint32_t number = parts[i].operand;
    for (; i < parts.size() && parts[i].operand == number; ++i)
      if (std::optional<Term> term = term_of(std::move(parts[i])))
        operand.push_back(*std::move(term));
    if (operand.empty()) operands.pop_back();
  }
  // What is convex comes first: sums of it are one part, not one for each part of the others.
  std::stable_partition(operands.begin(), operands.end(), [](const std::vector<Term>& operand) {
    return operand.size() == 1 && operand[0].solid;
  });
  std::vector<Term> sum;
  Sum sum_of_two(threads, budget);
  for (size_t i = 0; i < operands.size() && !budget.is_spent(); ++i)
    sum = i == 0 ? std::move(operands[0]) : sum_of_two(sum, operands[i]);
  std::vector<Shape> shapes;
  for (Term& term : sum) {
    if (term.solid)
      shapes.emplace_back(*std::move(term.solid));
    else
      shapes.emplace_back(Mesh{mesh_of(std::move(term.surface))});
  }
  return shapes;
}

}  // namespace whittle

#include "evaluate/corner_sets.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "evaluate/convex_hull.h"
#include "evaluate/extrusions.h"
#include "evaluate/flat_values.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// By fans of triangles, about a point of it.
double volume_of(const Polyhedron& solid) {
  double sum = 0;
  const Vec3 o = solid.points.front();
  for (const auto& face : solid.faces) {
    for (size_t k = 2; k < face.size(); ++k) {
      sum += dot(solid.points[face[0]] - o,
                 cross(solid.points[face[k]] - o, solid.points[face[k - 1]] - o));
    }
  }
  return sum / 6;
}

/// Whether a mesh is its own hull, as its volume tells.
bool is_convex(const TriangleMesh& mesh) {
  const std::optional<Polyhedron> hull = solid_hull(mesh.points);
  if (!hull) return false;
  constexpr double kSame = 1e-6;
  const double whole = volume_of(*hull);
  return std::fabs(volume(mesh) - whole) <= kSame * whole;
}

CornerSet extruded(std::span<const Vec2> outline, const LinearExtrude& how) {
  const Affine map = placement(how);
  CornerSet set;
  set.is_convex = true;
  for (const double z : {0.0, how.height})
    for (const Vec2 p : outline) set.points.push_back(map.point({p.x, p.y, z}));
  return set;
}

/// Each point of the one moved by each of the other.
std::optional<Polyhedron> sum_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b,
                                 Budget& budget) {
  if (!budget.work(uint64_t(a.size()) * b.size()) || !budget.spend(0)) return std::nullopt;
  std::vector<Vec3> points;
  points.reserve(a.size() * b.size());
  for (const Vec3 p : a)
    for (const Vec3 q : b) points.push_back(p + q);
  return solid_hull(points);
}

}  // namespace

CornerSet corners_of(const Shape& shape, bool wants_convex, Budget& budget) {
  CornerSet set;
  if (is_empty(shape) || !is_flat(shape)) return set;
  // There are not many more corners than facets.
  if (!budget.work(facet_count(shape) + 8)) return set;
  set.points = outline(shape);
  const TriangleMesh* const mesh = boundary(shape);
  set.is_convex = !mesh || (wants_convex && is_convex(*mesh));
  return set;
}

std::vector<CornerSet> extruded_corners(const Polygons& polygons, const LinearExtrude& how,
                                        bool wants_convex, Budget& budget) {
  std::vector<CornerSet> sets;
  if (polygons.is_empty() || !budget.work(2 * corner_count(polygons))) return sets;
  if (!wants_convex) {
    for (const Contour& contour : polygons.contours) sets.push_back(extruded(contour, how));
    return sets;
  }
  if (const std::optional<Contour> outline = convex_outline(polygons)) {
    sets.push_back(extruded(*outline, how));
    return sets;
  }
  for (const std::array<Vec2, 3>& triangle : triangulate(polygons)) {
    sets.push_back(extruded(triangle, how));
  }
  return sets;
}

std::optional<std::vector<Polyhedron>> minkowski_parts(std::vector<CornerSet> sets,
                                                       Budget& budget) {
  std::vector<Polyhedron> sums;
  std::erase_if(sets, [](const CornerSet& set) { return set.points.empty(); });
  for (size_t i = 0; i < sets.size();) {
    size_t end = i;
    std::vector<Polyhedron> parts;
    for (; end < sets.size() && sets[end].operand == sets[i].operand; ++end) {
      if (!sets[end].is_convex) return std::nullopt;
      std::optional<Polyhedron> part = solid_hull(sets[end].points);
      if (part) parts.push_back(std::move(*part));
    }
    if (i == 0) {
      sums = std::move(parts);
    } else {
      std::vector<Polyhedron> next;
      for (const Polyhedron& a : sums) {
        for (const Polyhedron& b : parts) {
          std::optional<Polyhedron> sum = sum_of(a.points, b.points, budget);
          if (budget.is_spent()) return std::nullopt;
          if (sum && !budget.spend(sum->faces.size())) return std::nullopt;
          if (sum) next.push_back(std::move(*sum));
        }
      }
      sums = std::move(next);
    }
    i = end;
  }
  return sums;
}

}  // namespace whittle

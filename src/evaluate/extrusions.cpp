#include "evaluate/extrusions.h"

#include <cmath>
#include <memory>
#include <utility>

#include "evaluate/flat_values.h"
#include "flat/extrude.h"
#include "shape/build_planes.h"

namespace whittle {
namespace {

/// With more triangles than this a mesh is not looked at: the search for a closed convex solid
/// would cost more than it saves.
constexpr size_t kMostConvexTriangles = 400;

/// The extrusion vector.
Vec3 vector_of(const LinearExtrude& how) {
  return how.direction.value_or(Vec3{0, 0, 1}) * how.height;
}

/// Slices that OpenSCAD may make: what the file asks for, or fragments along the twist. More are
/// made only for the least $fa and $fs, and those are counted here.
double most_slices(const LinearExtrude& how, double radius) {
  if (how.slices) return std::fmax(*how.slices, 1);
  const int fine = fragments(std::fmax(radius, 1), how.fragments);
  return std::fmax(1, std::ceil(fine * (std::fabs(how.twist_degrees) / 360 + 1)));
}

double radius_of(const Polygons& polygons) {
  double radius = 0;
  for (const Contour& contour : polygons.contours)
    for (const Vec2 p : contour) radius = std::fmax(radius, length(p));
  return radius;
}

/// False, and the budget spent, if so many facets are too many.
bool spend(Budget& budget, double facets) {
  return budget.spend(facets < 1e18 ? uint64_t(std::fmax(facets, 0)) : uint64_t(1e18));
}

}  // namespace

Polyhedron prism(const Contour& outline, double z0, double z1) {
  Polyhedron solid;
  const auto n = uint32_t(outline.size());
  solid.points.reserve(2 * size_t(n));
  for (const double z : {z0, z1})
    for (const Vec2 p : outline) solid.points.push_back({p.x, p.y, z});
  std::vector<uint32_t> below, above;
  for (uint32_t i = 0; i < n; ++i) {
    below.push_back(i);
    above.push_back(2 * n - 1 - i);
    // Clockwise from outside.
    const uint32_t next = (i + 1) % n;
    solid.faces.push_back({i, i + n, next + n, next});
  }
  solid.faces.push_back(std::move(below));
  solid.faces.push_back(std::move(above));
  build_planes(solid);
  return solid;
}

Shape straight_extrusion(const Polygons& polygons, double height, Budget& budget) {
  if (polygons.is_empty()) return Mesh{};
  if (const std::optional<Contour> outline = convex_outline(polygons);
      outline && outline->size() <= kMostPrismSides) {
    if (!budget.spend(outline->size() + 2)) return Mesh{};
    Polyhedron solid = prism(*outline, 0, height);
    if (!solid.planes.empty()) return solid;
  }
  if (!spend(budget, 4.0 * double(corner_count(polygons)))) return Mesh{};
  LinearExtrude how;
  how.height = height;
  TriangleMesh mesh = linear_extrude(polygons, how);
  return Mesh{std::make_shared<const TriangleMesh>(std::move(mesh))};
}

bool is_straight(const LinearExtrude& how) {
  return how.twist_degrees == 0 && how.scale == Vec2{1, 1};
}

bool is_flat_extrusion(const LinearExtrude& how) {
  const Vec3 v = vector_of(how);
  return !(v.z > 0) || !is_finite(v);
}

Affine placement(const LinearExtrude& how) {
  const Vec3 v = vector_of(how);
  Affine map;
  // v.z / height is 1 without a direction.
  map.row[0].z = v.x / how.height;
  map.row[1].z = v.y / how.height;
  map.row[2].z = how.direction ? v.z / how.height : 1;
  if (how.center) map.translation = v * -0.5;
  return map;
}

Shape sliced_extrusion(const Polygons& polygons, const LinearExtrude& how, Budget& budget) {
  if (polygons.is_empty() || is_flat_extrusion(how)) return Mesh{};
  const double corners = double(corner_count(polygons)) + (how.segments ? *how.segments : 0);
  if (!spend(budget, 2 * corners * (most_slices(how, radius_of(polygons)) + 1))) return Mesh{};
  return shape_of(linear_extrude(polygons, how), budget);
}

Shape faceted_revolution(const Polygons& polygons, const RotateExtrude& how, int facets,
                         Budget& budget) {
  if (polygons.is_empty() || how.angle_degrees == 0) return Mesh{};
  if (!spend(budget, 2.0 * double(corner_count(polygons)) * (double(facets) + 1))) return Mesh{};
  return shape_of(rotate_extrude(polygons, how, facets), budget);
}

Shape shape_of(TriangleMesh mesh, Budget& budget) {
  if (mesh.triangles.empty() || !budget.spend(0)) return Mesh{};
  if (mesh.triangles.size() <= kMostConvexTriangles) {
    Polyhedron solid;
    solid.points = mesh.points;
    for (const TriangleMesh::Triangle& t : mesh.triangles)
      solid.faces.push_back({t.corners[0], t.corners[2], t.corners[1]});
    if (build_planes(solid).refusal.empty() && !solid.planes.empty()) return solid;
  }
  return Mesh{std::make_shared<const TriangleMesh>(std::move(mesh))};
}

}  // namespace whittle

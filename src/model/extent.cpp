#include "model/extent.h"

#include <array>
#include <cmath>

#include "model/facets.h"

namespace whittle {

namespace {

constexpr Extent kUnbounded = {{}, kInfinity, kInfinity};

constexpr size_t kSpherePoints = 26;

std::vector<Vec3> sphere_outline(double r) {
  static const std::array<Vec3, kSpherePoints> directions = [] {
    std::array<Vec3, kSpherePoints> all;
    size_t count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0)
            all[count++] = normalize(Vec3{double(x), double(y), double(z)});
    return all;
  }();
  std::vector<Vec3> points;
  points.reserve(kSpherePoints);
  for (const Vec3& d : directions) points.push_back(d * r);
  return points;
}

std::vector<Vec3> side_outline(const Cylinder& s) {
  std::vector<Vec3> points;
  const double z0 = s.center ? -s.h / 2 : 0;
  for (const double f : {0.0, 0.5, 1.0}) {
    const double r = s.r1 + f * (s.r2 - s.r1);
    if (!(r > 0)) continue;
    for (size_t k = 0; k < kRingPoints; ++k) {
      const double angle = 360.0 / kRingPoints * double(k);
      points.push_back({r * cos_degrees(angle), r * sin_degrees(angle), z0 + f * s.h});
    }
  }
  return points;
}

double squared(Vec3 v) {
  return dot(v, v);
}

Vec3 middle_of(std::span<const Vec3> points) {
  Vec3 middle;
  for (const Vec3& p : points) middle += p / double(points.size());
  return middle;
}

double reach(std::span<const Vec3> points, Vec3 middle, const Affine& map) {
  double longest = 0;
  for (const Vec3& p : points) longest = std::max(longest, squared(map.vector(p - middle)));
  return std::sqrt(longest);
}

/// A plate's thickness, or about a third of a round body's: twice its volume over its area.
double mean_thickness(const TriangleMesh& mesh, const Affine& map) {
  double volume = 0, area = 0;
  const Vec3 origin = map.point(mesh.points.empty() ? Vec3{} : mesh.points[0]);
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3 a = map.point(mesh.points[t.corners[0]]) - origin,
               b = map.point(mesh.points[t.corners[1]]) - origin,
               c = map.point(mesh.points[t.corners[2]]) - origin;
    volume += dot(a, cross(b, c)) / 6;
    area += length(cross(b - a, c - a)) / 2;
  }
  return area > 0 ? 2 * std::fabs(volume) / area : 0;
}

}  // namespace

std::vector<Vec3> outline(const Shape& shape) {
  if (is_flat(shape)) return facet_vertices(shape);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere_outline(sphere->r);
  return side_outline(std::get<Cylinder>(shape));
}

Extent flat_extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                   const Affine& map) {
  if (outline.empty()) return kUnbounded;
  const Vec3 middle = middle_of(outline);
  const Affine back = inverse(map);
  double nearest = kInfinity;
  for (const Plane& plane : planes)
    nearest = std::min(nearest,
                       (plane.d - dot(plane.n, middle)) / length(back.transposed_vector(plane.n)));
  return {map.point(middle), reach(outline, middle, map), 2 * std::max(0.0, nearest)};
}

Extent mesh_extent(const TriangleMesh& mesh, const Affine& map) {
  Box box;
  for (const Vec3& p : mesh.points) box.include(map.point(p));
  return {box.center(), box.diagonal() / 2, mean_thickness(mesh, map)};
}

Extent extent(const Shape& shape, const Affine& map) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh_extent(*mesh->surface, map);
  const std::vector<Vec3> points = outline(shape);
  return is_flat(shape) ? flat_extent(points, facet_planes(shape), map)
                        : curved_extent(shape, points, map);
}

Extent united(const Extent& a, const Extent& b) {
  const double width = std::min(a.width, b.width);
  const Vec3 way = b.center - a.center;
  const double distance = length(way);
  if (distance + b.radius <= a.radius) return {a.center, a.radius, width};
  if (distance + a.radius <= b.radius) return {b.center, b.radius, width};
  const double radius = (distance + a.radius + b.radius) / 2;
  return {a.center + way * ((radius - a.radius) / distance), radius, width};
}

Extent curved_extent(const Shape& shape, std::span<const Vec3> points, const Affine& map) {
  const Affine back = inverse(map);
  const Vec3 middle = middle_of(points);
  const double radius = reach(points, middle, map);
  // A ball's image has the semi-axes 1 / sqrt(the eigenvalues of back^T back); their mean stands
  // for the largest.
  if (const auto* s = std::get_if<Sphere>(&shape)) {
    const double mean = (squared(back.row[0]) + squared(back.row[1]) + squared(back.row[2])) / 3;
    return {map.point(middle), radius, 2 * s->r / std::sqrt(mean)};
  }
  const auto& s = std::get<Cylinder>(shape);
  const double across =
      (s.r1 + s.r2) / std::sqrt((squared(back.row[0]) + squared(back.row[1])) / 2);
  return {map.point(middle), radius, std::min(across, s.h / length(back.row[2]))};
}

}  // namespace whittle

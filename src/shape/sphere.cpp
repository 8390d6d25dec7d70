#include "shape/sphere.h"

#include <array>

#include "base/degrees.h"
#include "shape/fragments.h"
#include "shape/points.h"

namespace whittle {
namespace {

/// Rings of OpenSCAD's sphere of n meridians; there is none at the poles.
int ring_count(int n) {
  return n / 2 + n % 2;
}

/// The box of a ball of radius r about the origin under a map: how far each row of it reaches.
Box ball_box(const Affine& map, double r) {
  const Vec3 reach = Vec3{length(map.row[0]), length(map.row[1]), length(map.row[2])} * r;
  return {map.translation - reach, map.translation + reach};
}

constexpr size_t kOutlinePoints = 26;

/// The directions of a cube's corners and of the middles of its edges and sides.
const std::array<Vec3, kOutlinePoints>& outline_directions() {
  static const std::array<Vec3, kOutlinePoints> directions = [] {
    std::array<Vec3, kOutlinePoints> all;
    size_t count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0)
            all[count++] = normalize(Vec3{double(x), double(y), double(z)});
    return all;
  }();
  return directions;
}

}  // namespace

bool Sphere::is_empty() const {
  return !is_size(r);
}

uint64_t Sphere::facet_count() const {
  // n faces between each two of the rings, and two caps.
  return facets > 0 ? uint64_t(facets) * uint64_t(ring_count(facets) - 1) + 2 : 0;
}

std::optional<Wall> Sphere::wall() const {
  if (facets > 0) return std::nullopt;
  return Wall{.center = {}, .squares = {1, 1, 1}, .constant = -r * r};
}

std::vector<Plane> Sphere::facet_planes() const {
  std::vector<Plane> planes;
  if (facets == 0) return planes;
  const int n = facets, rings = ring_count(n);
  const double apothem = cos_degrees(180.0 / n), half_step = cos_degrees(90.0 / rings);
  const std::vector<Vec3> middles = side_middles(n);
  planes.reserve(size_t(n) * size_t(rings - 1) + 2);
  planes.push_back({{0, 0, 1}, r * half_step});
  planes.push_back({{0, 0, -1}, r * half_step});
  for (int i = 1; i < rings; ++i) {
    // The chord between two rings is normal to the bisector of their polar angles; the middle of
    // a facet stands closer to the axis by the apothem. So written, the planes above and below
    // the equator mirror one another exactly.
    const double polar = 180.0 * i / rings;
    const Vec3 meridian = {sin_degrees(polar), 0, apothem * cos_degrees(polar)};
    const double scale = 1 / length(meridian);
    for (const Vec3 p : middles)
      planes.push_back({Vec3{meridian.x * p.x, meridian.x * p.y, meridian.z} * scale,
                        r * apothem * half_step * scale});
  }
  return planes;
}

size_t Sphere::plane_count() const {
  return facets > 0 ? size_t(facets) * size_t(ring_count(facets) - 1) + 2 : 0;
}

std::vector<Vec3> Sphere::outline() const {
  std::vector<Vec3> points;
  if (facets == 0) {
    points.reserve(kOutlinePoints);
    for (const Vec3& d : outline_directions()) points.push_back(d * r);
    return points;
  }
  const int rings = ring_count(facets);
  const std::vector<Vec3> circle = unit_circle(facets);
  points.reserve(size_t(facets) * size_t(rings));
  for (int i = 0; i < rings; ++i) {
    const double polar = 180.0 * (i + 0.5) / rings;
    const double across = r * sin_degrees(polar), z = r * cos_degrees(polar);
    for (const Vec3 p : circle) points.push_back({p.x * across, p.y * across, z});
  }
  return points;
}

std::vector<Box> Sphere::facet_boxes() const {
  // Two caps, then rows of n trapezoids; corners stand in rings of n, from the top.
  const std::vector<Vec3> corners = outline();
  const size_t n = size_t(facets), rings = corners.size() / n;
  std::vector<Box> boxes(2 + (rings - 1) * n);
  for (size_t k = 0; k < n; ++k) {
    boxes[0].include(corners[k]);
    boxes[1].include(corners[(rings - 1) * n + k]);
    for (size_t i = 1; i < rings; ++i)
      for (const size_t corner : {k, (k + 1) % n})
        for (const size_t ring : {i - 1, i})
          boxes[2 + (i - 1) * n + k].include(corners[ring * n + corner]);
  }
  return boxes;
}

Box Sphere::box(const Affine& map) const {
  return facets > 0 ? box_of(outline(), map) : ball_box(map, r);
}

Box Sphere::finite_box(const Affine& map) const {
  return ball_box(map, r);
}

Extent Sphere::extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                      const Affine& map) const {
  if (facets > 0) return flat_extent(outline, planes, map);
  // The outline is the same on both sides of the middle, and those half that come first are not
  // opposite one another.
  double longest = 0;
  const auto& directions = outline_directions();
  for (size_t i = 0; i < kOutlinePoints / 2; ++i) {
    const Vec3 way = map.vector(directions[i]);
    longest = std::max(longest, dot(way, way));
  }
  // A ball's image has the semi-axes 1 / sqrt(the eigenvalues of back^T back); their mean stands
  // for the largest.
  const Affine back = inverse(map);
  const double mean = (dot(back.row[0], back.row[0]) + dot(back.row[1], back.row[1]) +
                       dot(back.row[2], back.row[2])) /
                      3;
  return {map.translation, r * std::sqrt(longest), 2 * r / std::sqrt(mean)};
}

}  // namespace whittle

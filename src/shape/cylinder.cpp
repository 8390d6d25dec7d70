#include "shape/cylinder.h"

#include <algorithm>
#include <utility>

#include "base/degrees.h"
#include "shape/fragments.h"
#include "shape/points.h"

namespace whittle {
namespace {

double bottom(const Cylinder& c) {
  return c.center ? -c.h / 2 : 0;
}

double top(const Cylinder& c) {
  return c.center ? c.h / 2 : c.h;
}

/// The radius of an end: it may be a tip.
bool is_end_radius(double r) {
  return r >= 0 && std::isfinite(r);
}

/// The box of a circle of radius r about the z axis at height z, under a map.
Box circle_box(const Affine& map, double r, double z) {
  const Vec3 center = map.point({0, 0, z});
  const auto reach = [&](const Vec3& row) { return r * std::hypot(row.x, row.y); };
  const Vec3 half = {reach(map.row[0]), reach(map.row[1]), reach(map.row[2])};
  return {center - half, center + half};
}

}  // namespace

bool Cylinder::is_empty() const {
  return !(is_size(h) && is_end_radius(r1) && is_end_radius(r2) && r1 + r2 > 0);
}

uint64_t Cylinder::facet_count() const {
  return facets > 0 ? uint64_t(facets) + 2 : 0;
}

double Cylinder::widest_radius() const {
  return std::fmax(r1, r2);
}

std::optional<Wall> Cylinder::wall() const {
  if (facets > 0) return std::nullopt;
  // About the axis' middle: x^2 + y^2 - (r + s z)^2, r the mean radius.
  const double low = bottom(*this), r = (r1 + r2) / 2, s = (r2 - r1) / h;
  Wall wall{.center = {0, 0, low + h / 2},
            .squares = {1, 1, -s * s},
            .along = -r * s,
            .constant = -r * r};
  if (std::fabs(r) <= std::fabs(r2 - r1)) {
    // A tip at an end is exactly there.
    const double z = r1 == 0 ? low : r2 == 0 ? low + h : low + h * (r1 / (r1 - r2));
    wall.tip = {0, 0, z};
  }
  return wall;
}

std::vector<Plane> Cylinder::facet_planes() const {
  const double z0 = bottom(*this), z1 = top(*this);
  const Plane below{{0, 0, -1}, -z0}, above{{0, 0, 1}, z1};
  if (facets == 0) return {below, above};
  const int n = facets;
  std::vector<Plane> planes;
  planes.reserve(size_t(n) + 2);
  if (r1 > 0) planes.push_back(below);
  if (r2 > 0) planes.push_back(above);
  const double apothem = cos_degrees(180.0 / n), rise = (r1 - r2) * apothem;
  const double size = std::hypot(h, rise);
  const double across = h / size, up = rise / size;
  // Taken at the wider end, where cancellation is least.
  const double d = r1 >= r2 ? across * r1 * apothem + up * z0 : across * r2 * apothem + up * z1;
  for (const Vec3 p : side_middles(n)) planes.push_back({{across * p.x, across * p.y, up}, d});
  return planes;
}

size_t Cylinder::plane_count() const {
  return facets == 0 ? 2 : size_t(facets) + size_t(r1 > 0) + size_t(r2 > 0);
}

std::vector<Vec3> Cylinder::outline() const {
  std::vector<Vec3> points;
  if (facets == 0) {
    points.reserve(3 * kRingPoints);
    for (const double f : {0.0, 0.5, 1.0}) {
      const double r = r1 + f * (r2 - r1);
      if (!(r > 0)) continue;
      for (size_t k = 0; k < kRingPoints; ++k) {
        const double angle = 360.0 / kRingPoints * double(k);
        points.push_back({r * cos_degrees(angle), r * sin_degrees(angle), bottom(*this) + f * h});
      }
    }
    return points;
  }
  for (const auto& [r, z] : {std::pair{r1, bottom(*this)}, std::pair{r2, top(*this)}}) {
    if (r == 0) points.push_back({0, 0, z});
    for (const Vec3 p : unit_circle(r > 0 ? facets : 0)) points.push_back({p.x * r, p.y * r, z});
  }
  return points;
}

std::vector<Box> Cylinder::facet_boxes() const {
  // A cap for each ring, then the sides; of a tip there is one corner and no cap.
  const std::vector<Vec3> corners = outline();
  const size_t n = size_t(facets), below = r1 > 0 ? n : 1, above = r2 > 0 ? n : 1;
  const size_t caps = size_t(r1 > 0) + size_t(r2 > 0);
  std::vector<Box> boxes(caps + n);
  for (size_t k = 0; k < n; ++k) {
    if (below == n) boxes[0].include(corners[k]);
    if (above == n) boxes[caps - 1].include(corners[below + k]);
    for (const size_t corner : {k, (k + 1) % n}) {
      boxes[caps + k].include(corners[corner % below]);
      boxes[caps + k].include(corners[below + corner % above]);
    }
  }
  return boxes;
}

Box Cylinder::box(const Affine& map) const {
  if (facets > 0) return box_of(outline(), map);
  const double z = bottom(*this);
  return unite(circle_box(map, r1, z), circle_box(map, r2, z + h));
}

Box Cylinder::finite_box(const Affine& map) const {
  const double r = std::max(r1, r2);
  return transform(map, {{-r, -r, -h}, {r, r, h}});
}

Extent Cylinder::extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                        const Affine& map) const {
  if (facets > 0) return flat_extent(outline, planes, map);
  const Vec3 middle = middle_of(outline);
  const Affine back = inverse(map);
  const double across =
      (r1 + r2) / std::sqrt((dot(back.row[0], back.row[0]) + dot(back.row[1], back.row[1])) / 2);
  return {map.point(middle), reach(outline, middle, map),
          std::min(across, h / length(back.row[2]))};
}

}  // namespace whittle

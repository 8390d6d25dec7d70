#include "shape/extent.h"

#include "shape/points.h"

namespace whittle {

Extent flat_extent(std::span<const Vec3> corners, std::span<const Plane> planes,
                   const Affine& map) {
  if (corners.empty()) return {{}, kInfinity, kInfinity};
  const Vec3 middle = middle_of(corners);
  const Affine back = inverse(map);
  double nearest = kInfinity;
  for (const Plane& plane : planes)
    nearest = std::min(nearest,
                       (plane.d - dot(plane.n, middle)) / length(back.transposed_vector(plane.n)));
  return {map.point(middle), reach(corners, middle, map), 2 * std::max(0.0, nearest)};
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

}  // namespace whittle

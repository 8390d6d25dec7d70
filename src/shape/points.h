// Measures of sets of points.
#pragma once

#include <cmath>
#include <span>

#include "base/box.h"

namespace whittle {

/// The box of their images.
inline Box box_of(std::span<const Vec3> points, const Affine& map) {
  Box box;
  for (const Vec3& p : points) box.include(map.point(p));
  return box;
}

/// Their mean; the origin if there are none.
inline Vec3 middle_of(std::span<const Vec3> points) {
  Vec3 middle;
  for (const Vec3& p : points) middle += p / double(points.size());
  return middle;
}

/// How far the images of the points are at most from that of the middle.
inline double reach(std::span<const Vec3> points, Vec3 middle, const Affine& map) {
  double longest = 0;
  for (const Vec3& p : points) {
    const Vec3 way = map.vector(p - middle);
    longest = std::max(longest, dot(way, way));
  }
  return std::sqrt(longest);
}

}  // namespace whittle

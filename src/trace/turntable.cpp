#include "trace/turntable.h"

#include <algorithm>
#include <cmath>

#include "base/degrees.h"

namespace whittle {

Camera turned(Camera camera, Vec3 about, double degrees) {
  const double c = cos_degrees(degrees), s = sin_degrees(degrees);
  const auto turn = [&](Vec3 v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
  camera.eye = about + turn(camera.eye - about);
  for (Vec3* const axis : {&camera.right, &camera.up, &camera.forward}) *axis = turn(*axis);
  return camera;
}

Reach swept_reach(const Reach& reach, Vec3 about) {
  // The circle around the solid is inside of the one around its polygon of so many sides.
  constexpr int kSides = 32;
  double radius = 0;
  for (int side = 0; side < kSides; side += 4) {
    Directions directions;
    for (int i = 0; i < 4; ++i) {
      const double angle = 360.0 * (side + i) / kSides;
      directions[size_t(i)] = {cos_degrees(angle), sin_degrees(angle), 0};
    }
    const std::array<double, 4> found = reach(directions);
    for (size_t i = 0; i < 4; ++i) radius = std::max(radius, found[i] - dot(directions[i], about));
  }
  radius /= cos_degrees(180.0 / kSides);
  const std::array<double, 4> heights =
      reach({Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{0, 0, -1}});
  const double top = heights[0], bottom = -heights[1];
  return [=](const Directions& directions) {
    std::array<double, 4> most;
    std::ranges::transform(directions, most.begin(), [&](Vec3 d) {
      return d.x * about.x + d.y * about.y + radius * std::hypot(d.x, d.y) +
             std::max(d.z * top, d.z * bottom);
    });
    return most;
  };
}

}  // namespace whittle

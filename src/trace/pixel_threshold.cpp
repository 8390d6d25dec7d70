#include "trace/pixel_threshold.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// The visible space in camera coordinates (x right, y up, z forward), and the way to pixels.
struct Screen {
  bool orthographic;
  double half_width, half_height;  ///< at z = 1, or everywhere if orthographic
  double pixels_per_unit;          ///< the same

  explicit Screen(const Camera& camera)
      : orthographic(camera.orthographic),
        half_width(camera.half_height * camera.width / camera.height),
        half_height(camera.half_height),
        pixels_per_unit(camera.height / (2 * camera.half_height)) {}

  /// How far inside of each of the four sides a point is, in any unit. Between the sides of a
  /// perspective view z is not negative.
  double inside(int side, Vec3 p) const {
    const double reach = orthographic ? 1 : p.z;
    const double along = side < 2 ? p.x : p.y;
    const double limit = (side < 2 ? half_width : half_height) * reach;
    return side % 2 == 0 ? limit - along : limit + along;
  }

  double distance_in_pixels(Vec3 a, Vec3 b) const {
    if (!orthographic) a = a / a.z, b = b / b.z;
    return std::hypot(a.x - b.x, a.y - b.y) * pixels_per_unit;
  }
};

/// The length of the visible part of an edge. An edge through the eye gives infinity or NaN.
double visible_length(const Screen& screen, Vec3 a, Vec3 b) {
  double t0 = 0, t1 = 1;
  for (int side = 0; side < 4; ++side) {
    const double at_a = screen.inside(side, a), at_b = screen.inside(side, b);
    if (at_a < 0 && at_b < 0) return 0;
    const double t = at_a / (at_a - at_b);
    if (at_a < 0) t0 = std::max(t0, t);
    if (at_b < 0) t1 = std::min(t1, t);
  }
  if (t0 >= t1) return 0;
  return screen.distance_in_pixels(a + (b - a) * t0, a + (b - a) * t1);
}

bool is_met_by(const Box& box, const Ray& ray) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.lo[axis] || o > box.hi[axis]) return false;
      continue;
    }
    const double a = (box.lo[axis] - o) / d, b = (box.hi[axis] - o) / d;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

/// What a box covers of the screen is convex. So if all of its visible edges are short, it is
/// either small itself, or leaves out no more of the screen than a little near one corner.
bool covers_screen(const Camera& camera, const Box& box) {
  const double w = camera.width, h = camera.height;
  if (!is_met_by(box, camera.ray(w / 2, h / 2))) return false;
  const bool some_corner = is_met_by(box, camera.ray(0, 0)) || is_met_by(box, camera.ray(w, 0)) ||
                           is_met_by(box, camera.ray(0, h)) || is_met_by(box, camera.ray(w, h));
  return some_corner;
}

}  // namespace

bool is_below_pixels(const Camera& camera, const Box& box, double pixels) {
  const Screen screen(camera);
  Vec3 corners[8];
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = box.corner(i) - camera.eye;
    corners[i] = {dot(p, camera.right), dot(p, camera.up), dot(p, camera.forward)};
  }
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = i | 1 << axis;
      // Written so that a NaN is not small.
      if (other != i && !(visible_length(screen, corners[i], corners[other]) < pixels)) {
        return false;
      }
    }
  }
  return !covers_screen(camera, box);
}

}  // namespace whittle

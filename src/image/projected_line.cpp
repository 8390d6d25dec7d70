#include "image/projected_line.h"

#include <algorithm>

namespace whittle {
namespace {

/// What is at the eye itself is not in front of it.
constexpr double kTiny = 1e-300;
/// How far beyond the picture lines go on, pixels.
constexpr double kMargin = 4;

/// Right, up and forward of the eye.
Vec3 to_eye(const Camera& camera, Vec3 world) {
  const Vec3 p = world - camera.eye;
  return {dot(p, camera.right), dot(p, camera.up), dot(p, camera.forward)};
}

/// Cuts a segment off where it leaves what the camera sees and a little more; false if nothing is
/// left.
bool clip(const Camera& camera, Vec3& a, Vec3& b) {
  const double units = camera.units_per_pixel();
  const double x = (0.5 * camera.width + kMargin) * units;
  const double y = (0.5 * camera.height + kMargin) * units;
  const bool flat = camera.orthographic;
  const double nearest = flat ? -camera.ortho_reach : 1e-9 * std::max(length(a), length(b)) + kTiny;
  double first = 0, last = 1;
  const auto keep = [&](double at_a, double at_b) {  // where not negative
    if (at_a < 0 && at_b < 0) {
      last = -1;
    } else if (at_a < 0) {
      first = std::max(first, at_a / (at_a - at_b));
    } else if (at_b < 0) {
      last = std::min(last, at_a / (at_a - at_b));
    }
  };
  const auto side = [flat](Vec3 p, double reach) { return flat ? reach : reach * p.z; };
  keep(a.z - nearest, b.z - nearest);
  keep(side(a, x) - a.x, side(b, x) - b.x);
  keep(side(a, x) + a.x, side(b, x) + b.x);
  keep(side(a, y) - a.y, side(b, y) - b.y);
  keep(side(a, y) + a.y, side(b, y) + b.y);
  if (!(first <= last)) return false;
  const Vec3 start = a, way = b - a;
  a = start + way * first, b = start + way * last;
  return true;
}

Vec3 project(const Camera& camera, Vec3 p) {
  const double units = camera.units_per_pixel();
  const double scale = camera.orthographic ? 1 : 1 / p.z;
  return {0.5 * camera.width + p.x * scale / units, 0.5 * camera.height - p.y * scale / units,
          camera.orthographic ? p.z : scale};
}

}  // namespace

std::optional<ProjectedLine> project_line(const Camera& camera, Vec3 from, Vec3 to) {
  Vec3 a = to_eye(camera, from), b = to_eye(camera, to);
  if (!clip(camera, a, b)) return std::nullopt;
  a = project(camera, a), b = project(camera, b);
  if (!is_finite(a) || !is_finite(b)) return std::nullopt;
  for (Vec3* end : {&a, &b}) {
    // Of ends that are very far away rounding may leave more.
    end->x = std::clamp(end->x, -kMargin, camera.width + kMargin);
    end->y = std::clamp(end->y, -kMargin, camera.height + kMargin);
  }
  return ProjectedLine{a, b};
}

}  // namespace whittle

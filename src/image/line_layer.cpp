#include "image/line_layer.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr double kRadius = 0.55;  ///< pixels
/// A line that lies in a surface must not break up, and none may shine through from behind: a line
/// is seen if it is no more than this many pixels' width behind what the pixel shows.
constexpr double kBias = 3;
/// What is at the eye itself is not in front of it.
constexpr double kTiny = 1e-300;

}  // namespace

LineLayer::LineLayer(const Camera& camera, std::span<const double> occluders)
    : camera_(camera),
      occluders_(occluders),
      units_(camera.units_per_pixel()),
      inks_(occluders.size()) {}

void LineLayer::draw(Vec3 from, Vec3 to, const Ink& ink) {
  Vec3 a = to_eye(from), b = to_eye(to);
  if (clip(a, b)) draw_clipped(a, b, ink);
}

/// Right, up and forward of the eye.
Vec3 LineLayer::to_eye(Vec3 world) const {
  const Vec3 p = world - camera_.eye;
  return {dot(p, camera_.right), dot(p, camera_.up), dot(p, camera_.forward)};
}

/// Cuts a segment off where it leaves what the camera sees and a little more; false if nothing is
/// left.
bool LineLayer::clip(Vec3& a, Vec3& b) const {
  constexpr double kMargin = 4;  // pixels
  const double x = (0.5 * camera_.width + kMargin) * units_;
  const double y = (0.5 * camera_.height + kMargin) * units_;
  const bool flat = camera_.orthographic;
  const double nearest =
      flat ? -camera_.ortho_reach : 1e-9 * std::max(length(a), length(b)) + kTiny;
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

/// Of a point that clip() left: where it stands in the picture, and what is linear there in place
/// of its depth.
Vec3 LineLayer::project(Vec3 p) const {
  const double scale = camera_.orthographic ? 1 : 1 / p.z;
  return {0.5 * camera_.width + p.x * scale / units_, 0.5 * camera_.height - p.y * scale / units_,
          camera_.orthographic ? p.z : scale};
}

void LineLayer::draw_clipped(Vec3 a, Vec3 b, const Ink& ink) {
  const Vec3 start = project(a), way = project(b) - start;
  const double squared = way.x * way.x + way.y * way.y;
  const bool is_flat = std::fabs(way.x) >= std::fabs(way.y);
  const int major = is_flat ? 0 : 1, minor = 1 - major;
  const int size[2] = {camera_.width, camera_.height};
  const double slope = way[major] != 0 ? way[minor] / way[major] : 0;
  // Half of how far the line's ink reaches, measured along a column or row.
  const double reach = (kRadius + 0.5) * std::sqrt(1 + slope * slope);
  const auto pixel = [](double v, int pixels) {
    return int(std::clamp(std::floor(v), -1.0, double(pixels)));
  };
  const double lowest = std::min(start[major], start[major] + way[major]) - reach,
               highest = std::max(start[major], start[major] + way[major]) + reach;
  const int first = std::max(0, pixel(lowest, size[major])),
            last = std::min(size[major] - 1, pixel(highest, size[major]));
  for (int i = first; i <= last; ++i) {
    const double middle = start[minor] + slope * (i + 0.5 - start[major]);
    const int from = std::max(0, pixel(middle - reach, size[minor])),
              to = std::min(size[minor] - 1, pixel(middle + reach, size[minor]));
    for (int j = from; j <= to; ++j) {
      const double px = (is_flat ? i : j) + 0.5 - start.x, py = (is_flat ? j : i) + 0.5 - start.y;
      const double along =
          squared > 0 ? std::clamp((px * way.x + py * way.y) / squared, 0.0, 1.0) : 0;
      const double off = std::hypot(px - along * way.x, py - along * way.y);
      const double covered = std::clamp(kRadius + 0.5 - off, 0.0, 1.0);
      if (covered > 0) touch(is_flat ? i : j, is_flat ? j : i, start + way * along, covered, ink);
    }
  }
}

void LineLayer::touch(int x, int y, Vec3 projected, double covered, const Ink& ink) {
  const size_t i = size_t(y) * size_t(camera_.width) + size_t(x);
  const float strength = ink.strength * float(covered);
  if (strength <= inks_[i].strength) return;
  const double depth = camera_.orthographic ? projected.z : 1 / projected.z;
  const double pixel_width = units_ * (camera_.orthographic ? 1 : depth);
  const double distance =
      camera_.orthographic ? depth
                           : std::hypot((projected.x - 0.5 * camera_.width) * pixel_width,
                                        (projected.y - 0.5 * camera_.height) * pixel_width, depth);
  if (distance > occluders_[i] + kBias * pixel_width) return;
  inks_[i] = {ink.color, strength};
}

}  // namespace whittle

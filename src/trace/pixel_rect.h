// Which pixels a box can cover.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/box.h"
#include "trace/camera.h"

namespace whittle {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

/// All pixels whose centres' rays can meet the box (world coordinates, finite); the whole picture
/// if a corner is beside or behind a perspective eye. A pixel more on each side covers rounding.
inline PixelRect pixels_covering(const Camera& camera, const Box& box) {
  const PixelRect all{0, 0, camera.width, camera.height};
  const double pixels_per_unit = 1 / camera.units_per_pixel();
  double lo_x = kInfinity, hi_x = -kInfinity, lo_y = kInfinity, hi_y = -kInfinity;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = box.corner(i) - camera.eye;
    const double ahead = dot(p, camera.forward);
    if (!camera.orthographic && !(ahead > 1e-6 * length(p))) return all;
    const double scale = pixels_per_unit / (camera.orthographic ? 1 : ahead);
    const double x = 0.5 * camera.width + dot(p, camera.right) * scale,
                 y = 0.5 * camera.height - dot(p, camera.up) * scale;
    lo_x = std::min(lo_x, x), hi_x = std::max(hi_x, x);
    lo_y = std::min(lo_y, y), hi_y = std::max(hi_y, y);
  }
  const auto low = [](double v, int size) {
    return int(std::clamp(std::floor(v) - 1, 0.0, double(size)));
  };
  const auto high = [](double v, int size) {
    return int(std::clamp(std::ceil(v) + 1, 0.0, double(size)));
  };
  if (std::isnan(lo_x) || std::isnan(lo_y)) return all;
  return {low(lo_x, camera.width), low(lo_y, camera.height), high(hi_x, camera.width),
          high(hi_y, camera.height)};
}

}  // namespace whittle

#include "image/line_layer.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr double kRadius = 0.55;  ///< pixels
/// A line that lies in a surface must not break up, and none may shine through from behind: a line
/// is seen if it is no more than this many pixels' width behind what the pixel shows.
constexpr double kBias = 3;

}  // namespace

LineLayer::LineLayer(const Camera& camera, std::span<const double> occluders)
    : camera_(camera),
      occluders_(occluders),
      units_(camera.units_per_pixel()),
      inks_(occluders.size()) {}

void LineLayer::draw(Vec3 from, Vec3 to, const Ink& ink) {
  if (const std::optional<ProjectedLine> line = project_line(camera_, from, to))
    draw_projected(*line, ink);
}

void LineLayer::draw_projected(const ProjectedLine& line, const Ink& ink) {
  const Vec3 start = line.from, way = line.to - start;
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

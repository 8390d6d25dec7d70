#include "image/line_layer.h"

#include <algorithm>
#include <cmath>

#include "image/line_coverage.h"

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
  for_covered_pixels({line.from.x, line.from.y}, {line.to.x, line.to.y}, kRadius, camera_.width,
                     camera_.height, [&](int x, int y, double along, double covered) {
                       touch(x, y, start + way * along, covered, ink);
                     });
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

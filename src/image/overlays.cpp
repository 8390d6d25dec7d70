#include "image/overlays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "image/draw_strokes.h"
#include "image/line_layer.h"
#include "image/projected_line.h"

namespace whittle {
namespace {

/// How far axes and the grid go on beyond the solid, and how strong lines are.
constexpr double kBeyond = 0.15, kGridBeyond = 0.25;
constexpr float kAxisStrength = 0.95f, kNegativeStrength = 0.4f, kGridStrength = 0.28f,
                kGridAxisStrength = 0.55f;
constexpr Vec3f kAxisColors[3] = {{0.84f, 0.16f, 0.16f}, {0.13f, 0.6f, 0.2f}, {0.15f, 0.35f, 0.9f}};
constexpr const char* kAxisNames[3] = {"x", "y", "z"};

Box drawable(const Box& solid) {
  return solid.is_empty() || !solid.is_finite() ? Box{{-1, -1, -1}, {1, 1, 1}} : solid;
}

double longest_edge(const Box& box) {
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  return longest > 0 ? longest : 1;
}

Vec3 on_axis(int axis, double at) {
  Vec3 p;
  p[axis] = at;
  return p;
}

void draw_axes(const Box& box, LineLayer& lines) {
  const double beyond = kBeyond * longest_edge(box);
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(0.0, box.lo[axis]) - beyond,
                 high = std::max(0.0, box.hi[axis]) + beyond;
    lines.draw({}, on_axis(axis, high), {kAxisColors[axis], kAxisStrength});
    lines.draw({}, on_axis(axis, low), {kAxisColors[axis], kNegativeStrength});
  }
}

/// x, y and z beside the ends of the axes, where those are in the picture and seen.
void name_axes(const Box& box, const Camera& camera, std::span<const double> occluders,
               Picture& picture) {
  const double beyond = kBeyond * longest_edge(box),
               letters = letters_for(camera.width, camera.height);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 end = on_axis(axis, std::max(0.0, box.hi[axis]) + beyond);
    const std::optional<ProjectedLine> line = project_line(camera, {}, end);
    if (!line) continue;
    const Vec2 from{line->from.x, line->from.y}, to{line->to.x, line->to.y};
    const double length_seen = length(to - from);
    // An axis that one looks along has no end to be seen.
    if (length_seen < letters) continue;
    const Vec2 middle = to + (to - from) * (1.1 * letters / length_seen);
    const int x = int(std::floor(to.x)), y = int(std::floor(to.y));
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
    const Vec3 off = end - camera.eye;
    const double away = camera.orthographic ? dot(off, camera.forward) : length(off);
    if (occluders[size_t(y) * size_t(camera.width) + size_t(x)] < away) continue;
    const double width = text_width(kAxisNames[axis], letters);
    draw_strokes(
        text_strokes(kAxisNames[axis], {middle.x - width / 2, middle.y + letters / 3}, letters),
        letters / 7, {kAxisColors[axis], kAxisStrength}, picture);
  }
}

void draw_grid(const Box& box, const Vec3f& color, LineLayer& lines) {
  const double longest =
      std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, 1e-3 * longest_edge(box)});
  const double beyond = kGridBeyond * longest, all = longest + 2 * beyond;
  const GridLines along[2] = {grid_lines(box.lo.x - beyond, box.hi.x + beyond, all),
                              grid_lines(box.lo.y - beyond, box.hi.y + beyond, all)};
  for (int axis = 0; axis < 2; ++axis) {
    const GridLines &these = along[axis], &others = along[1 - axis];
    for (int i = 0; i < these.count; ++i) {
      const double at = these.first + i * these.step;
      Vec3 from = on_axis(axis, at), to = from;
      from[1 - axis] = others.first;
      to[1 - axis] = others.first + (others.count - 1) * others.step;
      const bool is_axis = std::fabs(at) < these.step / 2;
      lines.draw(from, to, {color, is_axis ? kGridAxisStrength : kGridStrength});
    }
  }
}

void draw_scale_bar(const Camera& camera, const Vec3f& color, Picture& picture) {
  WHITTLE_CHECK(camera.orthographic);
  constexpr double kMostShare = 0.25;
  const double units = camera.units_per_pixel(), letters = letters_for(camera.width, camera.height);
  const double length = round_length(kMostShare * camera.width * units), pixels = length / units;
  const double left = letters, y = camera.height - letters, tick = letters / 2;
  std::vector<Stroke> strokes = {{{left, y}, {left + pixels, y}},
                                 {{left, y - tick}, {left, y}},
                                 {{left + pixels, y - tick}, {left + pixels, y}}};
  const std::string text = fmt::format("{:.6g}", length);
  const double x = left + (pixels - text_width(text, letters)) / 2;
  for (Stroke& stroke : text_strokes(text, {std::max(left, x), y - 0.8 * letters}, letters))
    strokes.push_back(std::move(stroke));
  draw_strokes(strokes, std::max(1.2, letters / 8), {color, 1}, picture);
}

}  // namespace

double round_length(double most) {
  WHITTLE_CHECK(most > 0 && std::isfinite(most));
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {10.0, 5.0, 2.0, 1.0})
    if (factor * power <= most) return factor * power;
  return power;
}

GridLines grid_lines(double low, double high, double longest) {
  constexpr double kLeastLines = 10;
  const double step = round_length(longest / kLeastLines);
  const double first = std::floor(low / step), last = std::ceil(high / step);
  return {first * step, step, int(last - first) + 1};
}

void draw_overlays(const OverlaySettings& overlays, const Camera& camera, const Frame& frame,
                   const Box& solid, Picture& picture) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  WHITTLE_CHECK(picture.width == camera.width && picture.height == camera.height);
  const Box box = drawable(solid);
  const Vec3f color = readable_on(picture);
  if (overlays.axes || overlays.grid) {
    std::vector<double> occluders;
    occluders.reserve(frame.hits.size());
    for (const Hit& hit : frame.hits) occluders.push_back(double(hit.distance));
    LineLayer lines(camera, occluders);
    if (overlays.grid) draw_grid(box, color, lines);
    if (overlays.axes) draw_axes(box, lines);
    lay_over(lines.inks(), picture);
    if (overlays.axes) name_axes(box, camera, occluders, picture);
  }
  if (overlays.scale_bar) draw_scale_bar(camera, color, picture);
  if (!overlays.title.empty()) {
    const double letters = letters_for(camera.width, camera.height);
    draw_strokes(text_strokes(overlays.title, {letters, 2 * letters}, letters), letters / 7,
                 {color, 1}, picture);
  }
}

}  // namespace whittle

#include "image/draw_strokes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/line_coverage.h"

namespace whittle {
namespace {

/// Nothing is drawn of what begins or ends so many pixels beside a picture.
constexpr double kFarAway = 1e6;

bool is_near(Vec2 p) {
  return std::fabs(p.x) < kFarAway && std::fabs(p.y) < kFarAway;
}

}  // namespace

void draw_strokes(std::span<const Stroke> strokes, double width, const Ink& ink, Picture& picture) {
  std::vector<Ink> inks(picture.rgba.size() / 4);
  const auto draw = [&](Vec2 from, Vec2 to) {
    if (!is_near(from) || !is_near(to)) return;
    for_covered_pixels(from, to, width / 2, picture.width, picture.height,
                       [&](int x, int y, double, double covered) {
                         Ink& here = inks[size_t(y) * size_t(picture.width) + size_t(x)];
                         const float strength = ink.strength * float(covered);
                         if (strength > here.strength) here = {ink.color, strength};
                       });
  };
  for (const Stroke& stroke : strokes)
    for (size_t i = 1; i < stroke.size(); ++i) draw(stroke[i - 1], stroke[i]);
  lay_over(inks, picture);
}

Vec3f readable_on(const Picture& picture) {
  constexpr Vec3f kDark{0.1f, 0.1f, 0.12f}, kLight{0.94f, 0.94f, 0.92f};
  const uint8_t* corner = picture.at(0, 0);
  const bool is_light = corner[3] < 128 || 2 * corner[0] + 5 * corner[1] + corner[2] >= 4 * 255;
  return is_light ? kDark : kLight;
}

double letters_for(int width, int height) {
  constexpr double kLeast = 6, kShares = 40;
  return std::max(kLeast, std::round(std::min(width, height) / kShares));
}

}  // namespace whittle

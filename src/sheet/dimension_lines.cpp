#include "sheet/dimension_lines.h"

#include <utility>

namespace whittle {
namespace {

/// Lengths in heights of letters: where extension lines begin and how far they go on behind the
/// line with the arrows, how far that is away below and on the left, the arrows, and what is
/// between the number and the line.
constexpr double kFirst = 0.4, kOvershoot = 0.5, kBelow = 2.1, kOnTheLeft = 1.8, kArrow = 0.9,
                 kArrowHalf = 0.22, kNumber = 0.4;

}  // namespace

std::vector<Stroke> dimension_lines(Vec2 from, Vec2 to, bool vertical, std::string_view text,
                                    double letters) {
  // Everything is laid out as if below, and then turned: right becomes up, and down right.
  const double length = vertical ? to.y - from.y : to.x - from.x;
  // Of a vertical one the number stands on the far side of its line.
  const double away = (vertical ? kOnTheLeft : kBelow) * letters;
  const double out = vertical ? -1 : 1;  // down is away from the view
  std::vector<Stroke> strokes;
  const auto add_line = [&](Vec2 a, Vec2 b) { strokes.push_back({a, b}); };
  for (const double x : {0.0, length})
    add_line({x, out * kFirst * letters}, {x, out * (away + kOvershoot * letters)});

  const double width = text_width(text, letters), arrow = kArrow * letters;
  const bool has_room = length >= 3 * arrow;
  const bool number_fits = has_room && width + 0.5 * letters <= length;
  const double beyond = has_room ? 0 : 1.5 * arrow;
  add_line({-beyond, out * away}, {length + beyond, out * away});
  for (const auto& [tip, inwards] : {std::pair(0.0, 1.0), std::pair(length, -1.0)}) {
    const double back = tip + (has_room ? inwards : -inwards) * arrow;
    for (const double side : {-1.0, 1.0})
      add_line({tip, out * away}, {back, out * away + side * kArrowHalf * letters});
  }
  const double start = number_fits ? (length - width) / 2 : length + beyond + kNumber * letters;
  const double baseline = number_fits ? out * away - kNumber * letters : out * away + letters / 2;
  for (Stroke& stroke : text_strokes(text, {start, baseline}, letters))
    strokes.push_back(std::move(stroke));

  for (Stroke& stroke : strokes) {
    for (Vec2& p : stroke)
      p = vertical ? Vec2{to.x + p.y, to.y - p.x} : Vec2{from.x + p.x, from.y + p.y};
  }
  return strokes;
}

}  // namespace whittle

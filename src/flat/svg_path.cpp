// Path data: SVG 1.1, chapter 8.
#include <optional>
#include <utility>

#include "flat/svg_pen.h"
#include "flat/svg_values.h"

namespace whittle {
namespace {

class PathReader {
 public:
  PathReader(std::string_view data, SvgPen& pen) : scanner_(data), pen_(pen) {}

  void draw() {
    while (!scanner_.is_at_end() && !pen_.is_full()) {
      const char c = scanner_.peek();
      if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) {
        scanner_.skip();
        command_ = c;
      } else if (command_ == 'z' || command_ == 'Z') {
        break;
      }
      if (!segment()) break;
    }
    pen_.end_path();
  }

 private:
  enum class Curve { kNone, kQuadratic, kCubic };

  /// False if it is not whole, or no command.
  bool segment() {
    const bool is_relative = command_ >= 'a';
    origin_ = is_relative ? pen_.at() : Vec2{};
    const Curve before = std::exchange(last_, Curve::kNone);
    switch (is_relative ? command_ : char(command_ - 'A' + 'a')) {
      case 'm':
        return move();
      case 'l':
        return line();
      case 'h':
        return straight(true);
      case 'v':
        return straight(false);
      case 'c':
        return cubic(point());
      case 's':
        return cubic(before == Curve::kCubic ? mirrored() : pen_.at());
      case 'q':
        return quadratic(point());
      case 't':
        return quadratic(before == Curve::kQuadratic ? mirrored() : pen_.at());
      case 'a':
        return arc();
      case 'z':
        pen_.close();
        return true;
      default:
        return false;
    }
  }

  std::optional<Vec2> point() {
    const std::optional<double> x = scanner_.number(), y = scanner_.number();
    if (!x || !y) return {};
    return origin_ + Vec2{*x, *y};
  }
  Vec2 mirrored() const { return pen_.at() * 2 - control_; }

  bool move() {
    const std::optional<Vec2> to = point();
    if (!to) return false;
    pen_.move_to(*to);
    // Further points are lines.
    command_ = command_ == 'm' ? 'l' : 'L';
    return true;
  }
  bool line() {
    const std::optional<Vec2> to = point();
    if (to) pen_.line_to(*to);
    return to.has_value();
  }
  bool straight(bool is_horizontal) {
    const std::optional<double> value = scanner_.number();
    if (!value) return false;
    Vec2 to = pen_.at();
    (is_horizontal ? to.x : to.y) = *value + (is_horizontal ? origin_.x : origin_.y);
    pen_.line_to(to);
    return true;
  }
  bool cubic(std::optional<Vec2> first) {
    const std::optional<Vec2> second = point(), to = point();
    if (!first || !second || !to) return false;
    pen_.cubic_to(*first, *second, *to);
    control_ = *second;
    last_ = Curve::kCubic;
    return true;
  }
  bool quadratic(std::optional<Vec2> control) {
    const std::optional<Vec2> to = point();
    if (!control || !to) return false;
    pen_.quadratic_to(*control, *to);
    control_ = *control;
    last_ = Curve::kQuadratic;
    return true;
  }
  bool arc() {
    const std::optional<double> rx = scanner_.number(), ry = scanner_.number(),
                                turn = scanner_.number();
    const std::optional<bool> is_large = scanner_.flag(), is_positive = scanner_.flag();
    const std::optional<Vec2> to = point();
    if (!rx || !ry || !turn || !is_large || !is_positive || !to) return false;
    pen_.arc_to({{*rx, *ry}, *turn, *is_large, *is_positive}, *to);
    return true;
  }

  SvgScanner scanner_;
  SvgPen& pen_;
  char command_ = 'z';  ///< before the first nothing but a command will do
  Vec2 origin_, control_;
  Curve last_ = Curve::kNone;
};

}  // namespace

void draw_svg_path(std::string_view data, SvgPen& pen) {
  PathReader(data, pen).draw();
}

}  // namespace whittle

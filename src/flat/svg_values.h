// What stands in the attributes of an SVG file.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// An attribute that is a number and nothing else; of anything else 0, as OpenSCAD has it.
double svg_number(std::string_view text);
bool is_svg_number(std::string_view text);

/// Numbers one after the other, between them white space, a comma, or only what tells them apart.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : rest_(text) {}

  /// Past white space and commas. True: there is nothing more.
  bool is_at_end();
  /// The next character after white space and commas; 0 at the end.
  char peek() { return is_at_end() ? '\0' : rest_.front(); }
  void skip() { rest_.remove_prefix(1); }

  /// None, and nothing is passed, if there is no number. One that no double holds is 0.
  std::optional<double> number();
  /// A flag of an arc: a single 0 or 1.
  std::optional<bool> flag();
  /// Letters; empty if there are none.
  std::string_view word();

 private:
  std::string_view rest_;
};

/// x' = a x + c y + e, y' = b x + d y + f.
struct SvgMap {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  /// First `inner`, then this.
  SvgMap operator*(const SvgMap& inner) const;
};

/// A `transform` attribute. A step with a wrong number of values does nothing.
SvgMap svg_transform(std::string_view text);

/// Where the corners of a file come to lie. Points are SVG's, y down.
struct SvgPage {
  Vec2 size;  ///< mm
  Vec2 scale{1, 1}, align, view;
};

/// The page of an `svg` element by its attributes; empty: not given. `dpi` is for lengths without
/// a unit.
struct SvgPageText {
  std::string_view width, height, view_box, aspect_ratio;
};
SvgPage svg_page(const SvgPageText& text, double dpi);

}  // namespace whittle

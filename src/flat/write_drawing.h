// Files of drawings. Units are millimetres; y points up in the drawing.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "flat/polygons.h"

namespace whittle {

enum class DrawingFormat { kSvg, kDxf };

/// The file that OpenSCAD makes of such a drawing, but with all digits: each number is the shortest
/// that is the same double.
std::string write_drawing(std::span<const Contour> contours, DrawingFormat format);

/// An SVG as it grows. As in OpenSCAD's, a unit is a millimetre, y is turned round (it points down
/// in SVG), and the page is the smallest of whole millimetres that holds `bounds`.
class SvgWriter {
 public:
  /// `title` and what else comes from outside must be without `<`, `&` and quotation marks.
  SvgWriter(const Rect& bounds, std::string_view title);

  /// Attributes are as in ` id="a" fill="none"`, with the space in front.
  void begin_group(std::string_view attributes);
  void end_group();
  /// One path. Of closed ones the last corner is joined to the first.
  void add(std::span<const Contour> lines, bool closed, std::string_view attributes);
  /// The whole file. Nothing may be added any more.
  std::string finish() &&;

 private:
  std::string out_;
};

}  // namespace whittle

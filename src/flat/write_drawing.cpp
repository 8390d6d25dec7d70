#include "flat/write_drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/append_number.h"

namespace whittle {
namespace {

Rect bounds_of(std::span<const Contour> contours) {
  Rect box{contours[0][0], contours[0][0]};
  for (const Contour& contour : contours)
    for (const Vec2& p : contour) {
      box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
      box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
    }
  return box;
}

std::string svg(std::span<const Contour> contours) {
  SvgWriter writer(bounds_of(contours), "OpenSCAD Model");
  writer.add(contours, true, R"( stroke="black" fill="lightgray" stroke-width="0.5")");
  return std::move(writer).finish();
}

/// A pair of a group code and its value.
void append_pair(std::string& out, std::string_view code, double value) {
  out += code;
  append_number(out, value);
  out += '\n';
}

/// Lines, one by one, on layer 0: of the versions of DXF that know no more than these.
std::string dxf(std::span<const Contour> contours) {
  std::string out =
      "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n"
      "  0\nSECTION\n  2\nENTITIES\n";
  for (const Contour& contour : contours) {
    for (size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      out += "  0\nLINE\n  8\n0\n";
      append_pair(out, " 10\n", a.x);
      append_pair(out, " 20\n", a.y);
      append_pair(out, " 11\n", b.x);
      append_pair(out, " 21\n", b.y);
    }
  }
  out +=
      "  0\nENDSEC\n"
      "  0\nSECTION\n  2\nOBJECTS\n  0\nDICTIONARY\n  0\nENDSEC\n  0\nEOF\n";
  return out;
}

}  // namespace

std::string write_drawing(std::span<const Contour> contours, DrawingFormat format) {
  return format == DrawingFormat::kSvg ? svg(contours) : dxf(contours);
}

SvgWriter::SvgWriter(const Rect& bounds, std::string_view title) {
  const double left = std::floor(bounds.lo.x), top = std::floor(-bounds.hi.y);
  const double width = std::ceil(bounds.hi.x) - left, height = std::ceil(-bounds.lo.y) - top;
  out_ =
      "<?xml version=\"1.0\" standalone=\"no\"?>\n"
      "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" "
      "\"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n"
      "<svg width=\"";
  append_number(out_, width);
  out_ += "mm\" height=\"";
  append_number(out_, height);
  out_ += "mm\" viewBox=\"";
  const char* space = "";
  for (const double value : {left, top, width, height}) {
    out_ += std::exchange(space, " ");
    append_number(out_, value);
  }
  out_ += "\" xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\">\n<title>";
  out_ += title;
  out_ += "</title>\n";
}

void SvgWriter::begin_group(std::string_view attributes) {
  out_ += "<g";
  out_ += attributes;
  out_ += ">\n";
}

void SvgWriter::end_group() {
  out_ += "</g>\n";
}

void SvgWriter::add(std::span<const Contour> lines, bool closed, std::string_view attributes) {
  out_ += "<path d=\"\n";
  for (const Contour& line : lines) {
    const char* step = "M ";
    for (const Vec2& p : line) {
      out_ += std::exchange(step, " L ");
      append_number(out_, p.x);
      out_ += ',';
      append_number(out_, -p.y);
    }
    out_ += closed ? " z\n" : "\n";
  }
  out_ += '"';
  out_ += attributes;
  out_ += "/>\n";
}

std::string SvgWriter::finish() && {
  out_ += "</svg>\n";
  return std::move(out_);
}

}  // namespace whittle

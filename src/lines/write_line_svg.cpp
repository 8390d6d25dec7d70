#include "lines/write_line_svg.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace whittle {
namespace {

/// Text between tags. What XML cannot hold becomes a question mark.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return out;
}

const char* class_of(LineKind kind) {
  return kind == LineKind::kSilhouette ? "silhouette" : kind == LineKind::kEdge ? "edge" : "hidden";
}

/// Widths as ISO 128 has them; dashes are 12 and 3 widths long there, which is hard to see where
/// lines are short.
constexpr const char* kStyleToScale =
    ".silhouette { stroke-width: 0.5 }\n"
    ".edge { stroke-width: 0.25 }\n"
    ".hidden { stroke-width: 0.25; stroke-dasharray: 1.5 0.75 }\n";
constexpr const char* kStyleOfPicture =
    ".silhouette { stroke-width: 2 }\n"
    ".edge { stroke-width: 1 }\n"
    ".hidden { stroke-width: 1; stroke-dasharray: 5 3 }\n";

/// A coordinate in whole steps of the drawing, without zeros at its end.
void add_number(double value, int decimals, std::string& out) {
  const size_t start = out.size();
  fmt::format_to(std::back_inserter(out), "{:.{}f}", value, decimals);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  if (out.compare(start, std::string::npos, "-0") == 0) out.erase(start, 1);
}

}  // namespace

std::string write_line_svg(const LineDrawing& drawing, std::string_view title) {
  const int decimals = drawing.is_to_scale ? 3 : 2;
  const auto number = [decimals](double value) {
    std::string text;
    add_number(value, decimals, text);
    return text;
  };
  const char* const unit = drawing.is_to_scale ? "mm" : "";
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}{}\" height=\"{}{}\" "
      "viewBox=\"{} {} {} {}\">\n"
      "<title>{}</title>\n"
      "<style>\n"
      "path {{ fill: none; stroke: black; stroke-linecap: round; stroke-linejoin: round }}\n"
      "{}</style>\n",
      number(drawing.size.x), unit, number(drawing.size.y), unit, number(drawing.corner.x),
      number(drawing.corner.y), number(drawing.size.x), number(drawing.size.y), escaped(title),
      drawing.is_to_scale ? kStyleToScale : kStyleOfPicture);
  // Thick lines are drawn over thin ones.
  for (const LineKind kind : {LineKind::kHidden, LineKind::kEdge, LineKind::kSilhouette}) {
    bool is_open = false;
    for (const DrawnPath& path : drawing.paths) {
      if (path.kind != kind) continue;
      if (!is_open) out += fmt::format("<g class=\"{}\">\n", class_of(kind));
      is_open = true;
      out += "<path d=\"";
      char command = 'M';
      for (const Vec2 p : path.points) {
        out += command;
        add_number(p.x, decimals, out);
        out += ' ';
        add_number(p.y, decimals, out);
        command = 'L';
      }
      out += path.is_closed ? "Z\"/>\n" : "\"/>\n";
    }
    if (is_open) out += "</g>\n";
  }
  return out + "</svg>\n";
}

}  // namespace whittle

#include "lines/write_line_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace whittle {
namespace {

/// The bytes of the character at the start of the text, as UTF-8 in RFC 3629; 0 if it is none, or
/// one that XML 1.0 does not allow.
size_t xml_character_size(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 ? 0 : 1;
  const size_t size = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (size > text.size()) return 0;
  uint32_t code = first & (0x7fu >> size);
  for (size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool is_overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (is_overlong || is_surrogate || code > 0x10ffff || code == 0xfffe || code == 0xffff) return 0;
  return size;
}

/// Text between tags. Bytes that XML cannot hold become question marks: names of files may have
/// any.
std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const size_t size = xml_character_size(text);
    const std::string_view character = text.substr(0, std::max<size_t>(size, 1));
    if (size == 0)
      out += '?';
    else if (character == "&")
      out += "&amp;";
    else if (character == "<")
      out += "&lt;";
    else if (character == ">")
      out += "&gt;";
    else
      out += character;
    text.remove_prefix(character.size());
  }
  return out;
}

const char* class_of(LineKind kind) {
  switch (kind) {
    case LineKind::kSilhouette:
      return "silhouette";
    case LineKind::kEdge:
      return "edge";
    case LineKind::kHidden:
      return "hidden";
    case LineKind::kDimension:
      return "dimension";
  }
  return "";
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
  const bool has_dimensions = std::ranges::any_of(
      drawing.paths, [](const DrawnPath& path) { return path.kind == LineKind::kDimension; });
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}{}\" height=\"{}{}\" "
      "viewBox=\"{} {} {} {}\">\n"
      "<title>{}</title>\n"
      "<style>\n"
      "path {{ fill: none; stroke: black; stroke-linecap: round; stroke-linejoin: round }}\n"
      "{}{}</style>\n",
      number(drawing.size.x), unit, number(drawing.size.y), unit, number(drawing.corner.x),
      number(drawing.corner.y), number(drawing.size.x), number(drawing.size.y), escaped(title),
      drawing.is_to_scale ? kStyleToScale : kStyleOfPicture,
      has_dimensions ? ".dimension { stroke-width: 0.25 }\n" : "");
  // Thick lines are drawn over thin ones.
  for (const LineKind kind :
       {LineKind::kDimension, LineKind::kHidden, LineKind::kEdge, LineKind::kSilhouette}) {
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

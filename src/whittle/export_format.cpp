#include "whittle/export_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace whittle {
namespace {

constexpr Choice<ExportFormat> kFormats[] = {
    {"png", FileFormat::kPng},           {"exr", FileFormat::kExr},
    {"stl", SolidFormat::kStl},          {"off", SolidFormat::kOff},
    {"obj", SolidFormat::kObj},          {"3mf", SolidFormat::k3mf},
    {"amf", SolidFormat::kAmf},          {"svg", DrawingFormat::kSvg},
    {"dxf", DrawingFormat::kDxf},        {"gif", FilmFormat::kGif},
    {"apng", FilmFormat::kApng},         {"mp4", FilmFormat::kMp4},
    {"webm", FilmFormat::kWebm},         {"binstl", SolidFormat::kStl},
    {"asciistl", SolidFormat::kAsciiStl}};

/// Those that are endings, too.
constexpr size_t kEndings = std::size(kFormats) - 2;

}  // namespace

Choices<ExportFormat> export_format_choices() {
  return kFormats;
}

Result<ExportFormat> export_format_of(std::string_view path) {
  const size_t name = path.rfind('/') + 1, dot = path.rfind('.');
  std::string ending(dot == std::string_view::npos || dot < name ? "" : path.substr(dot + 1));
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Choice<ExportFormat>& choice : export_format_choices().first(kEndings)) {
    if (ending == choice.name) return choice.value;
  }
  return Error{ErrorKind::kUsage, fmt::format("'{}' does not end in {}, so its format is not known",
                                              path, export_endings())};
}

std::string export_endings() {
  std::string endings;
  for (size_t i = 0; i < kEndings; ++i) {
    if (i > 0) endings += i + 1 < kEndings ? ", " : " or ";
    (endings += '.') += kFormats[i].name;
  }
  return endings;
}

}  // namespace whittle

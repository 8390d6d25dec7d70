#include "host/input_kinds.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "mesh/mesh_files.h"

namespace whittle {
namespace {

struct Foreign {
  std::string_view first_bytes;
  std::string_view what;
};

constexpr std::array<Foreign, 3> kCompressed = {{
    {"\x1f\x8b", "compressed by gzip; unpack it first (gunzip)"},
    {"\xfd"
     "7zXZ",
     "compressed by xz; unpack it first (unxz)"},
    {"\x28\xb5\x2f\xfd", "compressed by zstd; unpack it first (unzstd)"},
}};

constexpr std::array<Foreign, 7> kForeign = {{
    {"PK\x03\x04", "a zip archive; unpack it first, or name it .3mf or .amf if it is such a mesh"},
    {"\x89PNG", "a picture (PNG), no model"},
    {"%PDF", "a PDF document, no model"},
    {"ISO-10303-21", "a STEP model; export a mesh (.stl) from the program that made it"},
    {"OFF\n", "a mesh (OFF); its name has to end in .off"},
    {"OFF\r", "a mesh (OFF); its name has to end in .off"},
    {"<", "XML; a drawing's name has to end in .svg, a mesh's in .amf"},
}};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return lower;
}

}  // namespace

InputKind kind_of_input(std::string_view path) {
  if (is_mesh_file(path)) return InputKind::kShape;
  const size_t name = path.rfind('/') + 1, dot = path.rfind('.');
  const std::string ending =
      lower_case(dot == std::string_view::npos || dot < name ? "" : path.substr(dot + 1));
  if (ending == "scad") return InputKind::kScad;
  return ending == "svg" || ending == "dxf" ? InputKind::kShape : InputKind::kCsg;
}

std::optional<std::string> describe_foreign(std::string_view bytes) {
  constexpr size_t kWord = 14;
  const std::string first = lower_case(bytes.substr(0, kWord));
  if (first.starts_with("<!doctype html") || first.starts_with("<html")) {
    return "it is a web page, no model";
  }
  if (std::optional<std::string> compressed = describe_compressed(bytes)) return compressed;
  for (const Foreign& foreign : kForeign) {
    if (bytes.starts_with(foreign.first_bytes)) return "it is " + std::string(foreign.what);
  }
  constexpr size_t kHead = 1024;
  const std::string_view head = bytes.substr(0, kHead);
  if (head.starts_with("solid") && head.find("facet") != std::string_view::npos) {
    return "it is a mesh (STL); its name has to end in .stl";
  }
  return std::nullopt;
}

std::optional<std::string> describe_compressed(std::string_view bytes) {
  for (const Foreign& foreign : kCompressed) {
    if (bytes.starts_with(foreign.first_bytes)) return "it is " + std::string(foreign.what);
  }
  constexpr std::string_view kPi = "1AY&SY";
  if (bytes.starts_with("BZh") &&
      bytes.substr(std::min<size_t>(4, bytes.size())).starts_with(kPi)) {
    return "it is compressed by bzip2; unpack it first (bunzip2)";
  }
  return std::nullopt;
}

std::string quoted_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace whittle

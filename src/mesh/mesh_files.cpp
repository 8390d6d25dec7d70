#include "mesh/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/limit_hint.h"
#include "mesh/formats.h"

namespace whittle {
namespace {

using Reader = Result<RawMesh> (*)(std::string_view content, size_t most_triangles);

struct Format {
  std::string_view suffix;
  Reader read;
};

constexpr Format kFormats[] = {
    {".stl", read_stl}, {".off", read_off}, {".obj", read_obj},
    {".amf", read_amf}, {".3mf", read_3mf},
};

const Format* format_of(std::string_view file_name) {
  std::string lower(file_name.substr(std::min(file_name.size(), file_name.rfind('.'))));
  for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
  const auto* const found = std::ranges::find(kFormats, lower, &Format::suffix);
  return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace

Error too_many_triangles(size_t most) {
  return mesh_error(
      fmt::format("it has more triangles than the limit of {}{}", most, limit_hint("facets")));
}

bool is_mesh_file(std::string_view file_name) {
  return format_of(file_name) != nullptr;
}

Result<RawMesh> read_mesh(std::string_view content, std::string_view file_name,
                          size_t most_triangles) {
  const Format* const format = format_of(file_name);
  if (format == nullptr) return mesh_error("its format is not known");
  return format->read(content, most_triangles);
}

}  // namespace whittle

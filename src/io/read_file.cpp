// Files by name: what kind they are decides how they are read.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_file.h"
#include "io/read.h"
#include "io/scad.h"

namespace whittle {
namespace {

Result<Read> read_scad(const std::string& path, const ReadOptions& options) {
  const Result<Flattened> flattened = flatten_scad(path);
  if (!flattened) return flattened.error();
  Result<Read> read = read_csg(flattened->csg, path + " (flattened)", options);
  if (!read) return read;
  // What openscad complains about comes before what whittle does.
  std::vector<std::string> warnings;
  std::string_view rest = flattened->messages;
  while (!rest.empty()) {
    const size_t newline = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, newline);
    rest.remove_prefix(std::min(newline + 1, rest.size()));
    if (!line.empty()) warnings.push_back(fmt::format("{}: openscad: {}", path, line));
  }
  read->warnings.insert(read->warnings.begin(), warnings.begin(), warnings.end());
  return read;
}

}  // namespace

Result<Read> read_file(const std::string& path, const ReadOptions& given) {
  ReadOptions options = given;
  if (!options.folder) options.folder = std::filesystem::path(path).parent_path().string();
  if (path.ends_with(".scad")) return read_scad(path, options);
  const Result<std::string> text = read_text(path, std::min(options.limits.bytes, kMostTextBytes));
  if (!text) return text.error();
  return read_csg(*text, path == "-" ? "<stdin>" : path, options);
}

}  // namespace whittle

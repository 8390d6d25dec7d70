#include "host/named_files.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "host/input_file.h"
#include "host/input_kinds.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

Error refuse(const std::string& why) {
  return {ErrorKind::kInput, "cannot be read: " + why};
}

bool is_within(const fs::path& root, const fs::path& path) {
  const auto ends = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return ends.first == root.end() && ends.second != path.end();
}

}  // namespace

NamedFiles named_files(std::string folder, std::optional<std::string> root, size_t most_bytes) {
  const auto left = std::make_shared<size_t>(most_bytes);
  return [folder = std::move(folder), root = std::move(root),
          left](const std::string& name) -> Result<std::optional<std::string>> {
    if (name.find('\0') != std::string::npos) return refuse("a name cannot have a zero byte");
    std::error_code error;
    fs::path path = fs::path(folder) / name;
    if (root) {
      const fs::path resolved_root = fs::canonical(*root, error);
      if (error) return refuse("the root of imports: " + error.message());
      // Whether a file is there is not told of places outside.
      path = fs::weakly_canonical(path, error);
      if (error) return refuse(error.message());
      if (!is_within(resolved_root, path)) return refuse("it lies outside the root of imports");
    }
    if (!fs::exists(path, error)) return std::optional<std::string>();
    Result<std::string> bytes = read_bytes(path.string(), *left);
    if (!bytes) return bytes.error();
    *left -= bytes->size();
    if (std::optional<std::string> what = describe_compressed(*bytes))
      return Error{ErrorKind::kInput, *std::move(what)};
    return std::optional(std::move(*bytes));
  };
}

}  // namespace whittle

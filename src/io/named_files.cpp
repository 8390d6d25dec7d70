#include "io/named_files.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "io/input_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

Error refuse(const std::string& why) {
  return {ErrorKind::kInput, "cannot be read: " + why};
}

bool is_within(const fs::path& root, const fs::path& path) {
  const auto [in_root, in_path] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return in_root == root.end() && in_path != path.end();
}

}  // namespace

std::function<Result<std::string>(const std::string&)> named_files(std::string folder,
                                                                   std::optional<std::string> root,
                                                                   size_t most_bytes) {
  const auto left = std::make_shared<size_t>(most_bytes);
  return [folder = std::move(folder), root = std::move(root),
          left](const std::string& name) -> Result<std::string> {
    if (name.find('\0') != std::string::npos) return refuse("a name cannot have a zero byte");
    std::error_code error;
    fs::path path = fs::path(folder) / name;
    if (root) {
      path = fs::canonical(path, error);
      if (error) return refuse(error.message());
      const fs::path resolved_root = fs::canonical(*root, error);
      if (error) return refuse("the root of imports: " + error.message());
      if (!is_within(resolved_root, path)) return refuse("it lies outside the root of imports");
    }
    Result<std::string> bytes = read_bytes(path.string(), *left);
    if (bytes) *left -= bytes->size();
    return bytes;
  };
}

}  // namespace whittle

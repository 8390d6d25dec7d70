#include "io/scad.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/child_process.h"
#include "io/input_file.h"
#include "io/pending_files.h"

namespace whittle {
namespace {

Error failure(ErrorKind kind, const std::string& path, const std::string& why) {
  return {kind, fmt::format("{}: error: {}", path, why)};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// A folder that nobody else can read, and that goes with what openscad wrote to it.
class PrivateFolder {
 public:
  static std::optional<PrivateFolder> create() {
    const char* const temporary = std::getenv("TMPDIR");
    // Not by mkdtemp, which tells the name only when the folder is there: an interruption may come
    // before it is known what to remove.
    constexpr int kMostAttempts = 1000;
    constexpr mode_t kOnlyMine = 0700;
    static std::atomic<unsigned> next_number = 0;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      PrivateFolder folder(fmt::format("{}/whittle-{}-{}",
                                       temporary && *temporary == '/' ? temporary : "/tmp",
                                       ::getpid(), next_number++));
      if (::mkdir(folder.path_.c_str(), kOnlyMine) == 0) return folder;
      folder.path_.clear();
      if (errno != EEXIST) break;
    }
    return std::nullopt;
  }
  PrivateFolder(PrivateFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), pending_(std::move(other.pending_)) {}
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder() {
    if (path_.empty()) return;
    ::unlink(csg().c_str());
    ::unlink(messages().c_str());
    ::rmdir(path_.c_str());
  }

  std::string csg() const { return path_ + "/model.csg"; }
  std::string messages() const { return path_ + "/messages"; }

 private:
  explicit PrivateFolder(std::string path)
      : path_(std::move(path)), pending_(std::make_unique<Pending>(*this)) {}

  struct Pending {
    explicit Pending(const PrivateFolder& folder)
        : path(folder.path_), csg(folder.csg()), messages(folder.messages()) {}
    // The folder first: what is pending is removed from the latest to the first.
    PendingFile path, csg, messages;
  };

  std::string path_;
  std::unique_ptr<Pending> pending_;
};

std::optional<std::string> find_program(const char* name) {
  const char* const variable = std::getenv("PATH");
  std::string_view rest = variable ? variable : "";
  while (!rest.empty()) {
    const size_t colon = std::min(rest.find(':'), rest.size());
    const std::string_view folder = rest.substr(0, colon);
    rest.remove_prefix(std::min(colon + 1, rest.size()));
    // An empty entry means the current folder, where a program of that name is rather a trap.
    if (folder.empty()) continue;
    std::string candidate = fmt::format("{}/{}", folder, name);
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

/// Several lines as one.
std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n') {
      line += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    } else if (!line.empty() && !line.ends_with("; ")) {
      line += "; ";
    }
  }
  if (line.ends_with("; ")) line.resize(line.size() - 2);
  return line;
}

}  // namespace

Result<Flattened> flatten_scad(const std::string& path) {
  const std::optional<std::string> program = find_program("openscad");
  if (!program) {
    return failure(ErrorKind::kMachine, path,
                   "a .scad file is evaluated by openscad, which is not on PATH; install it "
                   "(apt-get install openscad), or export the model as .csg elsewhere");
  }
  // openscad changes its folder to that of the source, so no path may be relative.
  char* const resolved = ::realpath(path.c_str(), nullptr);
  if (!resolved) {
    return failure(ErrorKind::kInput, path, "cannot be read: " + reason(errno));
  }
  const std::string source = resolved;
  std::free(resolved);
  const std::optional<PrivateFolder> folder = PrivateFolder::create();
  if (!folder) {
    return failure(ErrorKind::kMachine, path, "no temporary folder: " + reason(errno));
  }

  const std::string csg = folder->csg();
  const char* const arguments[] = {"openscad", "-o", csg.c_str(), source.c_str(), nullptr};
  int error = 0;
  const std::optional<int> status = run_program(*program, arguments, folder->messages(), error);
  if (!status) {
    return failure(ErrorKind::kMachine, path,
                   fmt::format("{} cannot be run: {}", *program, reason(error)));
  }
  Flattened flattened;
  if (Result<std::string> messages = read_text(folder->messages())) {
    flattened.messages = std::move(*messages);
  }
  Result<std::string> text = read_text(csg);
  if (*status != 0 || !text) {
    const std::string said = in_one_line(flattened.messages);
    return failure(ErrorKind::kInput, path,
                   fmt::format("openscad cannot evaluate it{}{}", said.empty() ? "" : ": ", said));
  }
  flattened.csg = std::move(*text);
  return flattened;
}

}  // namespace whittle

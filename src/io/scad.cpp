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

/// The place that a message of openscad's ends with, ` in file NAME, line NUMBER`, as `file:line`,
/// and the message before it; the file's own name where it names none.
struct Said {
  std::string place;
  std::string_view what;
};

Said split_place(std::string_view message, const std::string& path, const std::string& source) {
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const size_t file = message.rfind(kFile), line = message.rfind(kLine);
  if (file == std::string_view::npos || line == std::string_view::npos ||
      line < file + kFile.size()) {
    return {path, message};
  }
  const std::string_view number = message.substr(line + kLine.size());
  if (number.empty() || number.find_first_not_of("0123456789") != std::string_view::npos) {
    return {path, message};
  }
  const size_t name_start = file + kFile.size();
  const std::string_view name = message.substr(name_start, line - name_start);
  // openscad calls files as they are seen from the source's folder, and by where links lead.
  const bool is_source = name.empty() || name == source.substr(source.rfind('/') + 1);
  const std::string folder = name.starts_with('/') ? "" : path.substr(0, path.rfind('/') + 1);
  return {fmt::format("{}:{}", is_source ? path : fmt::format("{}{}", folder, name), number),
          message.substr(0, file)};
}

/// The first error among what openscad said. It goes on after one, without what comes then, and
/// its exit code may be 0.
std::optional<Error> first_error(std::string_view messages, const std::string& path,
                                 const std::string& source) {
  constexpr std::string_view kMark = "ERROR: ";
  for (size_t start = 0; start < messages.size();) {
    const size_t end = std::min(messages.find('\n', start), messages.size());
    const std::string_view line = messages.substr(start, end - start);
    start = end + 1;
    if (!line.starts_with(kMark)) continue;
    const Said said = split_place(line.substr(kMark.size()), path, source);
    return failure(ErrorKind::kInput, said.place, "openscad: " + in_one_line(said.what));
  }
  return std::nullopt;
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
  // openscad crashes on the one and says of the other that it can't open it.
  struct stat about {};
  const bool is_folder = ::stat(source.c_str(), &about) == 0 && S_ISDIR(about.st_mode);
  if (is_folder || ::access(source.c_str(), R_OK) != 0) {
    return failure(ErrorKind::kInput, path,
                   "cannot be read: " + reason(is_folder ? EISDIR : errno));
  }
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
  if (std::optional<Error> error_said = first_error(flattened.messages, path, source)) {
    return *std::move(error_said);
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

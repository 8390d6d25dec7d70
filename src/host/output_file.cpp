#include "host/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <system_error>
#include <utility>
#include <variant>

namespace whittle {
namespace {

// Two threads of one process must not take the same name; two processes differ in their ids. A file
// left by a process of the same id that was killed is in the way: then the next name is tried.
constexpr int kMostAttempts = 1000;
std::atomic<unsigned> next_number = 0;

/// The path that symbolic links lead to, also where nothing is there yet; or the error number.
std::variant<std::string, int> without_links(std::string path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  for (int links = 0; links <= kMostLinks; ++links) {
    char next[PATH_MAX];
    const ssize_t size = ::readlink(path.c_str(), next, sizeof next);
    if (size < 0) return path;
    if (size == sizeof next) return ENAMETOOLONG;
    const std::string_view link(next, static_cast<size_t>(size));
    if (link.starts_with('/')) path.clear();
    // rfind gives npos where there is no folder, and npos + 1 is 0.
    path.resize(path.rfind('/') + 1);
    path += link;
  }
  return ELOOP;
}

/// False for a file that is open but has lost its name, which /dev/fd can still reach.
bool is_name_of(const std::string& path, const struct stat& file) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && status.st_dev == file.st_dev &&
         status.st_ino == file.st_ino;
}

}  // namespace

Error OutputFile::system_error(int reason) const {
  return {ErrorKind::kMachine,
          fmt::format("cannot write '{}': {}", name_, std::generic_category().message(reason))};
}

Result<OutputFile> OutputFile::create(const std::string& target) {
  OutputFile file;
  file.name_ = target;
  std::variant<std::string, int> resolved = without_links(target);
  if (const int* const reason = std::get_if<int>(&resolved)) return file.system_error(*reason);
  file.target_ = std::get<std::string>(std::move(resolved));
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && !(S_ISREG(status.st_mode) && is_name_of(file.target_, status))) {
    file.target_ = target;
    file.descriptor_ = ::open(target.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.system_error(errno);
    return file;
  }
  if (exists) {
    // Renaming would replace a file that its owner has made read-only.
    if (::access(target.c_str(), W_OK) != 0) return file.system_error(errno);
  }
  const size_t slash = file.target_.rfind('/');
  const std::string folder =
      slash == std::string::npos ? std::string() : file.target_.substr(0, slash + 1);
  if (slash + 1 == file.target_.size()) return file.system_error(target.empty() ? ENOENT : EISDIR);
  for (int attempt = 0; attempt < kMostAttempts && file.descriptor_ < 0; ++attempt) {
    file.temporary_ = fmt::format("{}.whittle-{}-{}", folder, ::getpid(), next_number++);
    // Before the file is there: an interruption may come between any two steps.
    file.pending_ = std::make_unique<PendingFile>(file.temporary_);
    file.descriptor_ =
        ::open(file.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor_ < 0 && errno != EEXIST) break;
  }
  if (file.descriptor_ < 0) {
    const int reason = errno;
    file.temporary_.clear();
    file.pending_.reset();
    return file.system_error(reason);
  }
  if (exists && ::fchmod(file.descriptor_, status.st_mode & 07777) != 0) {
    return file.system_error(errno);
  }
  return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      pending_(std::move(other.pending_)) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return system_error(errno);
    }
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return Done{};
}

Status OutputFile::commit() {
  // Some file systems report only here that the disk is full.
  if (::close(std::exchange(descriptor_, -1)) != 0) return system_error(errno);
  if (temporary_.empty()) return Done{};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return system_error(errno);
  temporary_.clear();
  pending_.reset();
  return Done{};
}

Status write_file(const std::string& target, std::string_view bytes) {
  Result<OutputFile> file = OutputFile::create(target);
  if (!file) return file.error();
  if (Status written = file->write(bytes); !written) return written.error();
  return file->commit();
}

}  // namespace whittle

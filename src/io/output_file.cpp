#include "io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace whittle {
namespace {

// Two threads of one process must not take the same name; two processes differ in their ids. A file
// left by a process of the same id that was killed is in the way: then the next name is tried.
constexpr int kMostAttempts = 1000;
std::atomic<unsigned> next_number = 0;

std::string without_links(const std::string& path) {
  char* const resolved = ::realpath(path.c_str(), nullptr);
  if (!resolved) return path;
  std::string result = resolved;
  std::free(resolved);
  return result;
}

}  // namespace

Error OutputFile::system_error(int reason) const {
  return {ErrorKind::kMachine,
          fmt::format("cannot write '{}': {}", name_, std::generic_category().message(reason))};
}

Result<OutputFile> OutputFile::create(const std::string& target) {
  OutputFile file;
  file.name_ = target;
  file.target_ = target;
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) {
    file.descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.system_error(errno);
    return file;
  }
  if (exists) {
    // Renaming would replace a file that its owner has made read-only.
    if (::access(target.c_str(), W_OK) != 0) return file.system_error(errno);
    file.target_ = without_links(target);
  }
  const size_t slash = file.target_.rfind('/');
  const std::string folder =
      slash == std::string::npos ? std::string() : file.target_.substr(0, slash + 1);
  if (slash + 1 == file.target_.size()) return file.system_error(target.empty() ? ENOENT : EISDIR);
  for (int attempt = 0; attempt < kMostAttempts && file.descriptor_ < 0; ++attempt) {
    file.temporary_ = fmt::format("{}.whittle-{}-{}", folder, ::getpid(), next_number++);
    file.descriptor_ =
        ::open(file.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor_ < 0 && errno != EEXIST) break;
  }
  if (file.descriptor_ < 0) {
    const int reason = errno;
    file.temporary_.clear();
    return file.system_error(reason);
  }
  file.pending_ = std::make_unique<PendingFile>(file.temporary_);
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

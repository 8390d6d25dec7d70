#include "host/file_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace whittle {
namespace {

/// Reads up to `count` bytes from `first` on. Fewer only at the end, or if they cannot be read;
/// then errno says why, or is 0.
size_t read_at(int descriptor, size_t first, char* out, size_t count) {
  size_t size = 0;
  errno = 0;
  while (size < count) {
    const ssize_t got =
        ::pread(descriptor, out + size, count - size, static_cast<off_t>(first + size));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    size += static_cast<size_t>(got);
  }
  return size;
}

}  // namespace

std::unique_ptr<FileText> FileText::open(const std::string& path, size_t most_bytes) {
  // Not even opened: a pipe's writer would see that its reader goes.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return nullptr;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return nullptr;
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const auto size = static_cast<size_t>(status.st_size);
  if (!is_file || size == 0 || size > most_bytes) {
    ::close(descriptor);
    return nullptr;
  }
  return std::unique_ptr<FileText>(new FileText(path, descriptor, size));
}

FileText::~FileText() {
  ::close(descriptor_);
}

std::string_view FileText::read(size_t first, size_t count,
                                UninitializedVector<char>& buffer) const {
  count = std::min(count, text_.size() - first);
  if (buffer.size() < count) buffer = UninitializedVector<char>(count);
  return {buffer.data(), read_at(descriptor_, first, buffer.data(), count)};
}

Status FileText::load() {
  if (is_loaded_) return Done{};
  if (read_at(descriptor_, 0, text_.data(), text_.size()) < text_.size()) {
    const std::string why =
        errno != 0 ? std::generic_category().message(errno) : "it has become shorter meanwhile";
    return Error{ErrorKind::kInput, fmt::format("{}: error: cannot be read: {}", path_, why)};
  }
  is_loaded_ = true;
  return Done{};
}

}  // namespace whittle

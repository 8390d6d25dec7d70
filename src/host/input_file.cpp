#include "host/input_file.h"
#include "base/limit_hint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace whittle {
namespace {

/// All that is left to read, up to a little more than `most_bytes`, and of what is to be text up to
/// where it is none; the error number, or 0, in `error`.
std::string read_all(int descriptor, size_t most_bytes, bool only_text, int& error) {
  std::string text;
  struct stat status {};
  // One byte more than the file has, so that its end shows without growing the buffer.
  constexpr size_t kChunk = 1 << 16;
  const bool has_size = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const size_t expected = has_size ? static_cast<size_t>(status.st_size) + 1 : kChunk;
  text.resize(std::min(expected, most_bytes + 1));
  size_t size = 0;
  error = 0;
  while (size <= most_bytes) {
    if (size == text.size()) text.resize(std::min(2 * text.size(), most_bytes + 1));
    const ssize_t got = ::read(descriptor, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) error = errno;
    if (got <= 0) break;
    const bool has_zero = std::memchr(text.data() + size, 0, static_cast<size_t>(got)) != nullptr;
    size += static_cast<size_t>(got);
    if (only_text && has_zero) break;
  }
  text.resize(size);
  return text;
}

}  // namespace

Result<std::string> read_text(const std::string& path, size_t most_bytes) {
  const bool is_standard = path == "-";
  const int descriptor = is_standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  int error = errno;
  std::string text;
  if (descriptor >= 0) {
    text = read_all(descriptor, most_bytes, true, error);
    if (!is_standard) ::close(descriptor);
  }
  const auto refuse = [&](const std::string& why) {
    return Error{ErrorKind::kInput,
                 fmt::format("{}: error: {}", is_standard ? "<stdin>" : path, why)};
  };
  if (error != 0) return refuse("cannot be read: " + std::generic_category().message(error));
  if (text.size() > most_bytes) {
    return refuse(
        fmt::format("larger than the limit of {} bytes{}", most_bytes, limit_hint("bytes")));
  }
  return text;
}

Result<std::string> read_bytes(const std::string& path, size_t most_bytes) {
  const auto refuse = [](const std::string& why) {
    return Error{ErrorKind::kInput, "cannot be read: " + why};
  };
  // A pipe is opened without waiting for its writer.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return refuse(std::generic_category().message(errno));
  struct stat status {};
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  int error = 0;
  std::string bytes;
  if (is_file) bytes = read_all(descriptor, most_bytes, false, error);
  ::close(descriptor);
  if (!is_file) return refuse("it is not a file");
  if (error != 0) return refuse(std::generic_category().message(error));
  if (bytes.size() > most_bytes) {
    return refuse("with it more than the limit of bytes are read" + limit_hint("bytes"));
  }
  return bytes;
}

}  // namespace whittle

#include "io/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace whittle {
namespace {

// No text is longer (places in it are counted in 32 bits), but /dev/zero is.
constexpr size_t kMostBytes = (size_t{1} << 32) - 1;

/// All that is left to read; the error number, or 0, in `error`.
std::string read_all(int descriptor, int& error) {
  std::string text;
  struct stat status {};
  // One byte more than the file has, so that its end shows without growing the buffer.
  constexpr size_t kChunk = 1 << 16;
  const bool has_size = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (has_size && static_cast<size_t>(status.st_size) > kMostBytes) {
    error = EFBIG;
    return text;
  }
  text.resize(has_size ? static_cast<size_t>(status.st_size) + 1 : kChunk);
  size_t size = 0;
  error = 0;
  for (;;) {
    if (size == text.size()) text.resize(2 * text.size());
    const ssize_t got = ::read(descriptor, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) error = errno;
    if (got > 0 && size + static_cast<size_t>(got) > kMostBytes) error = EFBIG;
    if (got <= 0 || error != 0) break;
    size += static_cast<size_t>(got);
  }
  text.resize(size);
  return text;
}

}  // namespace

Result<std::string> read_text(const std::string& path) {
  const bool is_standard = path == "-";
  const int descriptor = is_standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  int error = errno;
  std::string text;
  if (descriptor >= 0) {
    text = read_all(descriptor, error);
    if (!is_standard) ::close(descriptor);
  }
  if (error != 0) {
    return Error{ErrorKind::kInput,
                 fmt::format("{}: error: cannot be read: {}", is_standard ? "<stdin>" : path,
                             std::generic_category().message(error))};
  }
  return text;
}

}  // namespace whittle

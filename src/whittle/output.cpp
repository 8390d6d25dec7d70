#include "whittle/output.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "host/output_file.h"
#include "image/exr.h"
#include "image/passes.h"
#include "image/png.h"

namespace whittle {
namespace {

Error machine_error(const std::string& name, int reason) {
  return {ErrorKind::kMachine,
          fmt::format("cannot write '{}': {}", name, std::generic_category().message(reason))};
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// An unnamed file in memory, which libraries that want a path can write to.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("whittle", MFD_CLOEXEC)) {}
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  /// All of it; on failure nothing, and the reason is in errno.
  std::optional<std::string> read() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) return std::nullopt;
    std::string bytes(size_t(status.st_size), '\0');
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t got = ::pread(descriptor_, bytes.data() + at, bytes.size() - at, off_t(at));
      if (got <= 0) return std::nullopt;
      at += size_t(got);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

Result<std::string> encode_png(const Picture& picture, bool with_alpha, const std::string& name) {
  char* buffer = nullptr;
  size_t size = 0;
  File stream(::open_memstream(&buffer, &size));
  if (!stream) return machine_error(name, errno);
  const Status written = write_png(stream.get(), name, picture, with_alpha);
  stream.reset();
  const std::unique_ptr<char, decltype(&std::free)> owned(buffer, &std::free);
  if (!written) return written.error();
  return std::string(buffer, size);
}

Result<std::string> encode_exr(const Frame& frame, const Picture& picture,
                               const std::string& name) {
  const MemoryFile file;
  if (!file.is_open()) return machine_error(name, errno);
  // The library's own message would name the file in memory.
  if (const Status written = write_exr(file.path(), frame, picture); !written) {
    return machine_error(name, ENOMEM);
  }
  std::optional<std::string> bytes = file.read();
  if (!bytes) return machine_error(name, errno);
  return std::move(*bytes);
}

}  // namespace

Result<FileFormat> format_of(std::string_view path) {
  const size_t name = path.rfind('/') + 1, dot = path.rfind('.');
  std::string ending(dot == std::string_view::npos || dot < name ? "" : path.substr(dot + 1));
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& choice : format_choices()) {
    if (ending == choice.name) return choice.value;
  }
  return Error{ErrorKind::kUsage,
               fmt::format("'{}' does not end in .{}, so its format is not known", path,
                           names_of(format_choices(), " or ."))};
}

Picture pass_picture(const Frame& frame, Pass pass, bool background) {
  WHITTLE_CHECK(pass != Pass::kColor);
  Picture picture = pass == Pass::kDepth    ? depth_pass(frame)
                    : pass == Pass::kNormal ? normal_pass(frame)
                                            : id_pass(frame);
  if (background) return picture;
  for (size_t i = 0; i < frame.hits.size(); ++i) {
    if (!frame.hits[i].hit()) picture.rgba[4 * i + 3] = 0;
  }
  return picture;
}

Result<std::string> encode(FileFormat format, const Frame& frame, const Picture& picture,
                           bool with_alpha, const std::string& name) {
  return format == FileFormat::kPng ? encode_png(picture, with_alpha, name)
                                    : encode_exr(frame, picture, name);
}

Status write_standard_output(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return machine_error("standard output", errno);
    bytes.remove_prefix(size_t(written));
  }
  return Done{};
}

Status write_output(const std::string& path, std::string_view bytes) {
  return path == "-" ? write_standard_output(bytes) : write_file(path, bytes);
}

Status check_not_input(const std::string& output, const std::string& input) {
  const auto look_at = [](const std::string& path, int standard, struct stat& status) {
    return (path == "-" ? ::fstat(standard, &status) : ::stat(path.c_str(), &status)) == 0;
  };
  struct stat out {
  }, in{};
  // Terminals and pipes may well be both.
  if (!look_at(output, STDOUT_FILENO, out) || !S_ISREG(out.st_mode) ||
      !look_at(input, STDIN_FILENO, in) || out.st_dev != in.st_dev || out.st_ino != in.st_ino) {
    return Done{};
  }
  return Error{
      ErrorKind::kUsage,
      fmt::format("-o {} is the file that is read, {}, which would be lost", output, input)};
}

Status check_writable(const std::string& path) {
  struct stat status {};
  // Opening a pipe or a device just to see would already do something to it.
  if (path == "-" || (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
                      !S_ISDIR(status.st_mode))) {
    return Done{};
  }
  const Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  return Done{};
}

}  // namespace whittle

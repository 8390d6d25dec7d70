#include "whittle/output.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>

#include "base/workers.h"
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
                           bool with_alpha, const std::string& name, int threads) {
  const Workers workers(threads);
  if (format == FileFormat::kPng) return encode_png(picture, with_alpha, &workers);
  Result<std::string> bytes = encode_exr(frame, picture, &workers);
  if (bytes) return bytes;
  return Error{bytes.error().kind,
               fmt::format("cannot write '{}': {}", name, bytes.error().message)};
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

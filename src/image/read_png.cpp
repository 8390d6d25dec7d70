#include "image/png.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace whittle {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

Result<Picture> read_png(const std::string& path) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    return Error{ErrorKind::kInput, path + ": cannot read: " + std::strerror(errno)};
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    Error error{ErrorKind::kInput, path + ": not a readable PNG: " + image.message};
    png_image_free(&image);
    return error;
  };
  if (!png_image_begin_read_from_stdio(&image, file.get())) return fail();
  image.format = PNG_FORMAT_RGBA;
  // The header of a broken file may claim any size.
  constexpr uint64_t kMaxPixels = uint64_t(1) << 28;
  if (uint64_t(image.width) * image.height > kMaxPixels) {
    png_image_free(&image);
    return Error{ErrorKind::kInput, path + ": the picture is too large"};
  }
  Picture picture = Picture::unfilled(int(image.width), int(image.height));
  if (!png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr)) return fail();
  return picture;
}

}  // namespace whittle

#include "image/png.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <memory>

namespace whittle {
namespace {

Error disk_error(const std::string& name, const std::string& why) {
  return {ErrorKind::kMachine, name + ": cannot write: " + why};
}

/// What libpng says last before it gives up.
struct Complaint {
  char text[160] = "libpng failed";
};

void on_error(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::strncpy(complaint->text, message, sizeof complaint->text - 1);
  complaint->text[sizeof complaint->text - 1] = 0;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// False if libpng gave up. Only plain values live here, as longjmp leaves this function.
bool encode(png_structp png, png_infop info, std::FILE* file, const Picture& picture,
            bool with_alpha, uint8_t* row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_set_IHDR(png, info, png_uint_32(picture.width), png_uint_32(picture.height), 8,
               with_alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  // A fifth of the time of libpng's defaults (512 x 512 in 2 to 3 ms) for files a third larger.
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(png, info);
  for (int y = 0; y < picture.height; ++y) {
    const uint8_t* from = picture.at(0, y);
    if (with_alpha) {
      std::memcpy(row, from, 4 * size_t(picture.width));
    } else {
      for (int x = 0; x < picture.width; ++x) {
        for (int k = 0; k < 3; ++k) row[3 * x + k] = from[4 * x + k];
      }
    }
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return true;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

Status write_png(std::FILE* file, const std::string& name, const Picture& picture,
                 bool with_alpha) {
  WHITTLE_CHECK(picture.width > 0 && picture.height > 0);
  Complaint complaint;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    return disk_error(name, "out of memory");
  }
  std::vector<uint8_t> row(4 * size_t(picture.width));
  errno = 0;
  const bool encoded = encode(png, info, file, picture, with_alpha, row.data());
  png_destroy_write_struct(&png, &info);
  if (encoded && std::fflush(file) == 0 && std::ferror(file) == 0) return Done{};
  return disk_error(name, errno != 0 ? std::strerror(errno) : complaint.text);
}

Status write_png(const std::string& path, const Picture& picture, bool with_alpha) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return disk_error(path, std::strerror(errno));
  Status written = write_png(file, path, picture, with_alpha);
  if (std::fclose(file) != 0 && written) return disk_error(path, std::strerror(errno));
  return written;
}

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

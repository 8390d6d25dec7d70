#include "mesh/decode_png.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>

#include "mesh/formats.h"

namespace whittle {
namespace {

/// The bytes that libpng has not had, and what it says last before it gives up.
struct Source {
  std::string_view rest;
  char complaint[160] = "";
};

void on_error(png_structp png, png_const_charp message) {
  auto* const source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->complaint, message, sizeof source->complaint - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, size_t count) {
  auto* const source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->rest.size() < count) png_error(png, "it was cut off");
  std::memcpy(to, source->rest.data(), count);
  source->rest.remove_prefix(count);
}

// What follows is left by longjmp; only plain values live in it.

bool read_head(png_structp png, png_infop info, PngPixels& pixels) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  pixels.width = png_get_image_width(png, info);
  pixels.height = png_get_image_height(png, info);
  return true;
}

bool read_rows(png_structp png, png_infop info, PngPixels& pixels) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_strip_16(png);
  png_set_expand(png);
  png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != 3 * pixels.width) png_error(png, "its rows are of no size");
  for (int pass = 0; pass < passes; ++pass)
    for (size_t y = 0; y < pixels.height; ++y)
      png_read_row(png, pixels.rgb.data() + 3 * pixels.width * y, nullptr);
  return true;
}

}  // namespace

Result<PngPixels> decode_png(std::string_view content, size_t most_pixels) {
  Source source{content};
  PngPixels pixels;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return Error{ErrorKind::kMachine, "out of memory"};
  }
  png_set_read_fn(png, &source, on_read);
  bool good = read_head(png, info, pixels);
  const bool fits = pixels.height == 0 || pixels.width <= most_pixels / pixels.height;
  if (good && fits) {
    pixels.rgb.resize(3 * pixels.width * pixels.height);
    good = read_rows(png, info, pixels);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) return mesh_error(fmt::format("this is no readable PNG: {}", source.complaint));
  if (!fits) return too_many_triangles(4 * most_pixels);
  return pixels;
}

}  // namespace whittle

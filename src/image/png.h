// PNG files: written here, by zlib on all threads, and read by libpng.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "base/workers.h"
#include "image/picture.h"

namespace whittle {

/// The bytes of a file with the picture as 8-bit RGBA, or as RGB if alpha is not wanted (the
/// colours stay as they are); the same with any number of workers. Precondition: the picture is
/// not empty.
std::string encode_png(const Picture& picture, bool with_alpha, const Workers* workers = nullptr);

/// The same as 8-bit grey, the picture's red.
std::string encode_grey_png(const Picture& picture, const Workers* workers = nullptr);

/// Reads any PNG as 8-bit RGBA.
Result<Picture> read_png(const std::string& path);

/// Adds a chunk of a PNG: how long, its name of four letters, the data, and their check.
void put_png_chunk(std::string& bytes, std::string_view name, std::string_view data);

}  // namespace whittle

// PNG files, by libpng.
#pragma once

#include <cstdio>
#include <string>

#include "base/result.h"
#include "image/picture.h"

namespace whittle {

/// Writes the picture as 8-bit RGBA, or as RGB if alpha is not wanted (the colours stay as they
/// are). Nothing is closed or removed; after an error (kMachine) the file may be incomplete.
/// Precondition: the picture is not empty. `name` is for messages.
Status write_png(std::FILE* file, const std::string& name, const Picture& picture, bool with_alpha);
/// The same to a file of that name, which is replaced.
Status write_png(const std::string& path, const Picture& picture, bool with_alpha);

/// Reads any PNG as 8-bit RGBA.
Result<Picture> read_png(const std::string& path);

}  // namespace whittle

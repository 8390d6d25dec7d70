// The numbers in a PNG.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle {

struct PngPixels {
  size_t width = 0, height = 0;
  std::vector<uint8_t> rgb;  ///< three a pixel, from the top row on
};

/// As they are in the file, whatever brightness it says they mean: of 16 bits the upper 8, grey as
/// three equal ones, of fewer bits spread over all 8, and without the alpha. An error if there are
/// more pixels than `most_pixels`.
Result<PngPixels> decode_png(std::string_view content, size_t most_pixels);

}  // namespace whittle

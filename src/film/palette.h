// The few colours that show a picture best.
#pragma once

#include <cstdint>
#include <vector>

#include "image/picture.h"

namespace whittle {

/// A picture as places in a list of colours, rows from the top.
struct IndexedPicture {
  std::vector<Rgb8> colors;
  std::vector<uint8_t> indices;
};

/// The picture in at most `most` colours, 2 to 256: exact if it has no more (to 1 of 127 levels),
/// else those of a median cut. With `with_alpha` index 0 is no colour, but where alpha is less than
/// half. The same for the same picture.
///
/// Based on: Heckbert, "Color image quantization for frame buffer display", 1982. What we changed:
/// the box with the largest sum of squared errors is cut next, and at its mean.
IndexedPicture to_palette(const Picture& picture, size_t most, bool with_alpha);

}  // namespace whittle

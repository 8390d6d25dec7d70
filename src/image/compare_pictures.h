// Are two pictures the same, as far as people see? For the facts behind them: compare.h.
#pragma once

#include <string>

#include "image/picture.h"

namespace whittle {

/// A pixel differs if one of its channels is more than this many of 255 levels off: less is what
/// other rounding does.
inline constexpr int kVisibleLevels = 8;

struct PictureComparison {
  int width_a = 0, height_a = 0, width_b = 0, height_b = 0;
  size_t differing = 0;  ///< pixels; 0 if the sizes differ
  int most_levels = 0;   ///< the largest difference of a channel
  int x = 0, y = 0;      ///< the first that differs, by rows

  bool same_size() const { return width_a == width_b && height_a == height_b; }
  /// Of all pixels; 1 if the sizes differ.
  double share() const {
    return same_size() ? double(differing) / (double(width_a) * double(height_a)) : 1;
  }
};

/// What is transparent in both is equal, whatever its colour.
PictureComparison compare(const Picture& a, const Picture& b);

/// In words, without an end of line.
std::string describe(const PictureComparison& comparison);

/// The first picture, pale, and red where they differ. Empty if the sizes do.
Picture difference_picture(const Picture& a, const Picture& b);

}  // namespace whittle

#include "image/compare_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace whittle {
namespace {

/// The largest difference of a channel.
int levels_between(const uint8_t* a, const uint8_t* b) {
  if (a[3] == 0 && b[3] == 0) return 0;
  int most = 0;
  for (int i = 0; i < 4; ++i) most = std::max(most, std::abs(int(a[i]) - int(b[i])));
  return most;
}

}  // namespace

PictureComparison compare(const Picture& a, const Picture& b) {
  PictureComparison result{a.width, a.height, b.width, b.height};
  if (!result.same_size()) return result;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const int levels = levels_between(a.at(x, y), b.at(x, y));
      result.most_levels = std::max(result.most_levels, levels);
      if (levels <= kVisibleLevels) continue;
      if (result.differing++ == 0) result.x = x, result.y = y;
    }
  }
  return result;
}

std::string describe(const PictureComparison& c) {
  if (!c.same_size()) {
    return fmt::format("different sizes: {} x {} and {} x {}", c.width_a, c.height_a, c.width_b,
                       c.height_b);
  }
  const size_t pixels = size_t(c.width_a) * size_t(c.height_a);
  if (c.differing == 0)
    return fmt::format("{} pixels agree within {} of 255 levels", pixels, c.most_levels);
  return fmt::format(
      "{} of {} pixels differ ({:.3g} %), by up to {} of 255 levels; the first at {},{}",
      c.differing, pixels, 100 * c.share(), c.most_levels, c.x, c.y);
}

Picture difference_picture(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return {};
  Picture picture(a.width, a.height);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const uint8_t* from = a.at(x, y);
      uint8_t* const to = picture.at(x, y);
      const bool differs = levels_between(from, b.at(x, y)) > kVisibleLevels;
      for (int i = 0; i < 3; ++i) to[i] = uint8_t(191 + from[i] / 4);
      if (differs) to[0] = 220, to[1] = 30, to[2] = 30;
      to[3] = 255;
    }
  }
  return picture;
}

}  // namespace whittle

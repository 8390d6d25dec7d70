#include "image/block_sums.h"

#include "image/edge_lanes.h"

namespace whittle {
namespace {

constexpr size_t kRowsPerTask = 16;

}  // namespace

void BlockSums::add_rows(std::vector<uint32_t>& numbers) const {
  workers_.for_parts(height_, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    std::vector<uint32_t> sums(width_ + 1), before(width_), after(width_);
    for (size_t y = first; y < last; ++y) {
      uint32_t* row = &numbers[y * width_];
      if (std::all_of(row, row + width_, [](uint32_t v) { return v == 0; })) continue;
      const uint8_t* bits = &differences_[y * width_];
      for (size_t x = 1; x < width_; ++x) before[x] = bits[x - 1] & kRight ? 0 : before[x - 1] + 1;
      for (size_t x = width_ - 1; x-- > 0;) after[x] = bits[x] & kRight ? 0 : after[x + 1] + 1;
      // Sums may wrap around; their differences are right.
      for (size_t x = 0; x < width_; ++x) sums[x + 1] = sums[x] + row[x];
      for (size_t x = 0; x < width_; ++x) {
        const Window window = window_of(before[x], after[x]);
        row[x] = sums[x + window.after + 1] - sums[x - window.before];
      }
    }
  });
}

/// Some columns at a time, so that all that is touched lies side by side.
void BlockSums::add_columns(std::vector<uint32_t>& numbers) const {
  constexpr size_t kStrip = 64;
  workers_.for_parts((width_ + kStrip - 1) / kStrip, 1, [&](size_t first, size_t last, size_t) {
    std::vector<uint32_t> sums((height_ + 1) * kStrip), before(height_ * kStrip);
    std::vector<uint32_t> after(kStrip);
    for (size_t strip = first; strip < last; ++strip) {
      const size_t x0 = strip * kStrip, columns = std::min(kStrip, width_ - x0);
      for (size_t y = 0; y < height_; ++y) {
        const uint32_t* row = &numbers[y * width_ + x0];
        const uint32_t* sum = &sums[y * kStrip];
        uint32_t* next_sum = &sums[(y + 1) * kStrip];
        for (size_t x = 0; x < columns; ++x) next_sum[x] = sum[x] + row[x];
        if (y == 0) continue;
        const uint8_t* bits = &differences_[(y - 1) * width_ + x0];
        const uint32_t* above = &before[(y - 1) * kStrip];
        uint32_t* here = &before[y * kStrip];
        for (size_t x = 0; x < columns; ++x) here[x] = bits[x] & kBelow ? 0 : above[x] + 1;
      }
      for (size_t y = height_; y-- > 0;) {
        const uint8_t* bits = &differences_[y * width_ + x0];
        for (size_t x = 0; x < columns; ++x) {
          after[x] = y + 1 == height_ || bits[x] & kBelow ? 0 : after[x] + 1;
          const Window window = window_of(before[y * kStrip + x], after[x]);
          numbers[y * width_ + x0 + x] =
              sums[(y + window.after + 1) * kStrip + x] - sums[(y - window.before) * kStrip + x];
        }
      }
    }
  });
}

}  // namespace whittle

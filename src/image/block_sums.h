// Sums of what a few rays found, over the connected pixels around each pixel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/workers.h"

namespace whittle {

/// Over as many pixels as a block has, so that all of its directions (directions.h) are among them;
/// where an edge is near, over more on the other side. Sums are of whole numbers, which are the
/// same in any order.
class BlockSums {
 public:
  /// Of how many rays a number tells, and how much of the shares that they saw. Sums of numbers are
  /// numbers, of at most 2047 rays.
  static uint32_t packed(double share, uint32_t rays) {
    return rays | uint32_t(share * kWhole + 0.5) << kShareShift;
  }
  static uint32_t rays_of(uint32_t number) { return number & kMostRays; }
  /// The mean share; `without_any` of no rays.
  static double mean(uint32_t number, double without_any) {
    const uint32_t rays = rays_of(number);
    return rays > 0 ? double(number >> kShareShift) / double(rays) / kWhole : without_any;
  }

  /// `differences` says by pixel which later neighbours are not connected with it
  /// (LaterNeighbour); `block` is in pixels, both ways. What it is told must outlive it.
  BlockSums(size_t width, size_t height, std::span<const uint8_t> differences, size_t block,
            const Workers& workers)
      : differences_(differences),
        workers_(workers),
        width_(width),
        height_(height),
        others_(uint32_t(block - 1)) {}

  /// Replaces each pixel's number by the sum over its block.
  void add_up(std::vector<uint32_t>& numbers) const {
    add_rows(numbers);
    add_columns(numbers);
  }

 private:
  static constexpr double kWhole = 1 << 10;
  static constexpr uint32_t kShareShift = 11, kMostRays = (1u << kShareShift) - 1;

  struct Window {
    uint32_t before, after;
  };
  Window window_of(uint32_t before, uint32_t after) const {
    const uint32_t most_after = std::min(after, others_);
    const uint32_t taken = std::min(before, std::max((others_ + 1) / 2, others_ - most_after));
    return {taken, std::min(after, others_ - taken)};
  }
  void add_rows(std::vector<uint32_t>& numbers) const;
  void add_columns(std::vector<uint32_t>& numbers) const;

  const std::span<const uint8_t> differences_;
  const Workers& workers_;
  const size_t width_, height_;
  const uint32_t others_;  ///< pixels in a row of a block, but one
};

}  // namespace whittle

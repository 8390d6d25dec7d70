#include "image/edge_pixels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "base/result.h"
#include "image/edge_lanes.h"

namespace whittle {
namespace {

constexpr size_t kRowsPerTask = 16;
constexpr size_t kBlockSide = 4;

}  // namespace

std::vector<uint8_t> later_differences(const Frame& frame, const Camera& camera,
                                       const Workers& workers, float least_cosine) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  const PixelRays rays(camera);
  const size_t width = size_t(frame.width), height = size_t(frame.height);
  std::vector<uint8_t> bits(frame.hits.size());
  workers.for_parts(height, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    EdgeRow here(width), below(width);
    const auto look = [&](size_t y, EdgeRow& row) {
      look_at_row(rays, std::span(&frame.hits[y * width], width), int(y), row);
    };
    look(first, below);
    for (size_t y = first; y < last; ++y) {
      std::swap(here, below);
      if (y + 1 < height) look(y + 1, below);
      find_differences(here, y + 1 < height ? &below : nullptr, least_cosine,
                       std::span(&bits[y * width], width));
    }
  });
  return bits;
}

std::vector<uint8_t> edge_mask(const std::vector<uint8_t>& differences, size_t width,
                               const Workers& workers) {
  const size_t height = differences.size() / width;
  std::vector<uint8_t> mask(differences.size());
  const std::vector<uint8_t> none(width);
  workers.for_parts(height, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t y = first; y < last; ++y) {
      const uint8_t* bits = &differences[y * width];
      const uint8_t* above = y > 0 ? bits - width : none.data();
      uint8_t* row = &mask[y * width];
      for (size_t x = 0; x < width; ++x) {
        unsigned found = bits[x] | (above[x] & kBelow);
        if (x > 0) found |= (bits[x - 1] & kRight) | (above[x - 1] & kBelowRight);
        if (x + 1 < width) found |= above[x + 1] & kBelowLeft;
        row[x] = found != 0;
      }
    }
  });
  return mask;
}

std::vector<uint8_t> edge_mask(const Frame& frame, const Camera& camera, const Workers& workers) {
  return edge_mask(later_differences(frame, camera, workers, kCosEdge), size_t(frame.width),
                   workers);
}

std::vector<size_t> places_in_blocks(const std::vector<uint8_t>& mask, size_t width) {
  std::vector<size_t> places;
  const size_t height = mask.size() / width;
  for (size_t y0 = 0; y0 < height; y0 += kBlockSide) {
    // The next place of each row.
    std::array<size_t, kBlockSide> next{};
    const size_t rows = std::min(kBlockSide, height - y0);
    const auto find_next = [&](size_t row, size_t from) {
      const auto start = mask.begin() + ptrdiff_t((y0 + row) * width);
      next[row] = size_t(std::find(start + ptrdiff_t(from), start + ptrdiff_t(width), 1) - start);
    };
    for (size_t row = 0; row < rows; ++row) find_next(row, 0);
    while (true) {
      const size_t first = *std::min_element(next.begin(), next.begin() + ptrdiff_t(rows));
      if (first == width) break;
      const size_t end = std::min(width, (first / kBlockSide + 1) * kBlockSide);
      for (size_t row = 0; row < rows; ++row)
        for (; next[row] < end; find_next(row, next[row] + 1))
          places.push_back((y0 + row) * width + next[row]);
    }
  }
  return places;
}

}  // namespace whittle

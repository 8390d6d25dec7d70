#include "viewer/enlarge.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace whittle {
namespace {

/// Of the neighbours that a fine pixel lies between: the first, and how much the second counts, in
/// 1/128.
struct Place {
  int first = 0, second = 0, weight = 0;
};

constexpr int kOne = 128, kBits = 7;

std::vector<Place> places(int coarse, int scale, int fine) {
  std::vector<Place> result;
  result.reserve(size_t(fine));
  for (int i = 0; i < fine; ++i) {
    // Both pictures have the same middle.
    const double at = (i + 0.5 - fine / 2.0) / scale + coarse / 2.0 - 0.5;
    const double below = std::floor(at);
    const int first = std::clamp(int(below), 0, coarse - 1);
    result.push_back({first, std::min(first + 1, coarse - 1),
                      at < 0 ? 0 : int(std::lround((at - below) * kOne))});
  }
  return result;
}

/// A row of the coarse picture, as wide as the fine one.
void widen(const uint8_t* row, const std::vector<Place>& columns, uint8_t* out) {
  for (const auto& [first, second, weight] : columns) {
    const uint8_t *a = row + 4 * first, *b = row + 4 * second;
    for (int c = 0; c < 4; ++c)
      *out++ = uint8_t((a[c] * (kOne - weight) + b[c] * weight + kOne / 2) >> kBits);
  }
}

}  // namespace

Camera coarse_camera(const Camera& camera, int scale) {
  Camera coarse = camera;
  coarse.width = (camera.width + scale - 1) / scale;
  coarse.height = (camera.height + scale - 1) / scale;
  coarse.half_height = camera.half_height * (double(coarse.height) * scale / camera.height);
  return coarse;
}

Picture enlarged(const Picture& coarse, int scale, int width, int height, const Workers& workers) {
  Picture fine = Picture::unfilled(width, height);
  const std::vector<Place> columns = places(coarse.width, scale, width),
                           rows = places(coarse.height, scale, height);
  constexpr size_t kRows = 64;
  workers.for_parts(size_t(height), kRows, [&](size_t begin, size_t end, size_t) {
    std::vector<uint8_t> upper(4 * size_t(width)), lower(4 * size_t(width));
    int upper_row = -1, lower_row = -1;
    for (size_t y = begin; y < end; ++y) {
      const auto& [first, second, weight] = rows[y];
      if (upper_row != first) {
        if (lower_row == first)
          upper.swap(lower);
        else
          widen(coarse.at(0, first), columns, upper.data());
        upper_row = first;
        lower_row = -1;
      }
      if (lower_row != second) {
        widen(coarse.at(0, second), columns, lower.data());
        lower_row = second;
      }
      uint8_t* const out = fine.at(0, int(y));
      for (size_t i = 0; i < upper.size(); ++i)
        out[i] = uint8_t((upper[i] * (kOne - weight) + lower[i] * weight + kOne / 2) >> kBits);
    }
  });
  return fine;
}

}  // namespace whittle

// Points to look at in a cell.
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace whittle {

/// Places in a cell, as shares of its half size, that no model favours: the first sixteen of the
/// Halton sequence in bases 2, 3 and 5, moved a little.
inline constexpr std::array<Vec3, 16> kCellProbes = [] {
  std::array<Vec3, 16> all{};
  const auto radical_inverse = [](int i, int base) {
    double result = 0, digit = 1;
    for (; i > 0; i /= base) result += (digit /= base) * (i % base);
    return result;
  };
  for (int i = 0; i < 16; ++i) {
    Vec3 p{radical_inverse(i + 1, 2) + 0.0137, radical_inverse(i + 1, 3) - 0.0211,
           radical_inverse(i + 1, 5) + 0.0173};
    for (int axis = 0; axis < 3; ++axis)
      all[std::size_t(i)][axis] = 1.9 * (p[axis] - (p[axis] >= 1 ? 1 : 0)) - 0.95;
  }
  return all;
}();

/// One of them, from the cell's middle.
inline Vec3 cell_probe(size_t i, Vec3 half) {
  const Vec3& share = kCellProbes[i];
  return {share.x * half.x, share.y * half.y, share.z * half.z};
}

}  // namespace whittle

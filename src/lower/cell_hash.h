// Unit cells of a space of any dimension, for hash tables of what stands near one another.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace whittle {

template <size_t N>
using CellPlace = std::array<int64_t, N>;

/// The cell of a coordinate. The last cell takes all coordinates that are too large, and NaN.
inline int64_t cell_coordinate(double x) {
  constexpr double kFar = 1e15;
  return x > -kFar ? x < kFar ? int64_t(std::floor(x)) : int64_t(kFar) : -int64_t(kFar);
}

template <size_t N>
uint64_t hash_of(const CellPlace<N>& cell) {
  uint64_t hash = 0;
  for (const int64_t c : cell) {
    hash = (hash ^ uint64_t(c)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace whittle

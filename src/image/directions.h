// Directions in which rays look round: evenly spread, the same in every run.
//
// Based on: Keller and Heidrich, "Interleaved sampling" (2001): neighbouring pixels look in
// different directions, and those of a block look in all of them. The directions are those of a
// (0, 2)-sequence (Sobol 1967), so 4^k in a row of them are spread evenly, too.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// Pixels a side of a block that shares its directions.
inline constexpr size_t kDirectionBlock = 8;
inline constexpr uint32_t kBlockDirections = uint32_t(kDirectionBlock * kDirectionBlock);

/// Which of a block's directions a pixel has. Blocks of 2 x 2 and 4 x 4 pixels have ones that
/// follow one another.
constexpr uint32_t direction_of_pixel(size_t x, size_t y) {
  uint32_t number = 0;
  for (uint32_t bit = 0; bit < 3; ++bit)
    number |= uint32_t(x >> bit & 1) << (2 * bit) | uint32_t(y >> bit & 1) << (2 * bit + 1);
  return number;
}

/// Point i of the first `count` of the sequence, in the middle of its part of the unit square.
inline Vec2 spread_point(uint32_t i, uint32_t count) {
  uint32_t x = 0, y = 0;
  uint32_t column = uint32_t(1) << 31;
  for (uint32_t bit = 0; bit < 32; ++bit, column ^= column >> 1) {
    if ((i >> bit & 1) == 0) continue;
    x |= uint32_t(1) << (31 - bit);
    y ^= column;
  }
  const double middle = 0.5 / count;
  return {std::ldexp(double(x), -32) + middle, std::ldexp(double(y), -32) + middle};
}

/// The point in the unit disc; even areas stay even.
inline Vec2 on_disc(Vec2 p) {
  const double r = std::sqrt(p.x), angle = 2 * std::numbers::pi * p.y;
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// Three unit axes at right angles, the third of which is given.
///
/// Based on: Duff et al., "Building an orthonormal basis, revisited" (2017).
struct Axes {
  Vec3 x, y, z;

  explicit Axes(Vec3 unit) : z(unit) {
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }

  /// Above a point of the unit disc; so directions fall as often as their cosine is large.
  Vec3 over(Vec2 disc) const {
    const double up = std::sqrt(std::fmax(0.0, 1 - disc.x * disc.x - disc.y * disc.y));
    return normalize(x * disc.x + y * disc.y + z * up);
  }
};

/// The places of a lattice, of `columns` by `rows`, that look round; in an order in which rays walk
/// together that start near one another and go nearly the same way.
template <class Looks, class DirectionAt>
std::vector<uint32_t> in_walking_order(size_t columns, size_t rows, const Looks& looks,
                                       const DirectionAt& direction_at) {
  constexpr size_t kPatch = 32;
  std::array<uint32_t, kBlockDirections> rank;
  std::array<uint32_t, kBlockDirections> by_way;
  for (uint32_t i = 0; i < kBlockDirections; ++i) by_way[i] = i;
  // Quarters of the disc, and quarters of those.
  const auto way = [](uint32_t i) {
    const Vec2 disc = on_disc(spread_point(i, kBlockDirections));
    const auto x = uint32_t((disc.x + 1) * 8), y = uint32_t((disc.y + 1) * 8);
    uint32_t z_order = 0;
    for (uint32_t bit = 0; bit < 4; ++bit)
      z_order |= (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1);
    return z_order;
  };
  std::ranges::stable_sort(by_way, {}, way);
  for (uint32_t i = 0; i < kBlockDirections; ++i) rank[by_way[i]] = i;

  std::vector<uint32_t> places;
  std::array<std::vector<uint32_t>, kBlockDirections> patch;
  for (size_t y0 = 0; y0 < rows; y0 += kPatch) {
    for (size_t x0 = 0; x0 < columns; x0 += kPatch) {
      for (size_t y = y0; y < std::min(y0 + kPatch, rows); ++y)
        for (size_t x = x0; x < std::min(x0 + kPatch, columns); ++x)
          if (looks(x, y)) patch[rank[direction_at(x, y)]].push_back(uint32_t(y * columns + x));
      for (std::vector<uint32_t>& same : patch) {
        places.insert(places.end(), same.begin(), same.end());
        same.clear();
      }
    }
  }
  return places;
}

}  // namespace whittle

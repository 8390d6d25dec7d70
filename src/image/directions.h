// Directions in which rays look round: evenly spread, the same in every run.
//
// Based on: Keller and Heidrich, "Interleaved sampling" (2001): neighbouring pixels look in
// different directions, and those of a block look in all of them. The directions are those of a
// (0, 2)-sequence (Sobol 1967), so 4^k in a row of them are spread evenly, too.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

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

}  // namespace whittle

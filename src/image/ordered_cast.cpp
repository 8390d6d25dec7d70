#include "image/ordered_cast.h"

#include <cmath>

namespace whittle {
namespace {

/// Bits of x and y in turn, those of x at the even places.
uint32_t z_order(uint32_t x, uint32_t y, uint32_t bits) {
  uint32_t number = 0;
  for (uint32_t bit = 0; bit < bits; ++bit)
    number |= (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1);
  return number;
}

}  // namespace

uint32_t OrderedCast::way_of(size_t x, size_t y, Vec3 direction) {
  // Within an octant two of the direction's parts tell it, as shares of their sum.
  constexpr uint32_t kDirectionBits = 3, kBlock = 16, kBlockBits = 10;
  constexpr double kDirections = 1 << kDirectionBits;
  const Vec3 d = abs(direction);
  const double scale = (kDirections - 0.5) / (d.x + d.y + d.z);
  const uint32_t along = z_order(uint32_t(d.x * scale), uint32_t(d.y * scale), kDirectionBits);
  const uint32_t block = z_order(uint32_t(x / kBlock), uint32_t(y / kBlock), kBlockBits);
  const uint32_t octant =
      uint32_t(direction.x < 0) | uint32_t(direction.y < 0) << 1 | uint32_t(direction.z < 0) << 2;
  return octant << (2 * kBlockBits + 2 * kDirectionBits) | block << (2 * kDirectionBits) | along;
}

}  // namespace whittle

// Numbers as shaders read them, two words each: a double, or the float next to it and the float
// next to what is left.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace whittle {

inline std::array<uint32_t, 2> words_of(double value, bool doubles) {
  if (doubles) {
    const auto bits = std::bit_cast<uint64_t>(value);
    return {uint32_t(bits), uint32_t(bits >> 32)};
  }
  const auto nearest = float(value);
  return {std::bit_cast<uint32_t>(nearest), std::bit_cast<uint32_t>(float(value - nearest))};
}

}  // namespace whittle

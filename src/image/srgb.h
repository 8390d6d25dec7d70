// The sRGB transfer curve (IEC 61966-2-1), and a table of it: no pow a pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace whittle {

/// Linear light 0..1 of an sRGB value 0..1.
float linear_from_srgb(float v);
/// sRGB value 0..1 of linear light 0..1.
float srgb_from_linear(float v);

inline constexpr int kSrgbSteps = 1 << 13;  ///< 12.92 * 255 / kSrgbSteps = 0.4 levels at black

/// 8-bit sRGB of linear light in steps of 1 / kSrgbSteps: looked up at the nearest step, it is off
/// by at most one level, and only where the exact value lies within a fifth of a level of the
/// border between two. Behind the last are zeros, so that each byte can be read as four. Made at
/// the first call.
using SrgbTable = std::array<uint8_t, kSrgbSteps + 1 + 3>;
const SrgbTable& srgb_table();

}  // namespace whittle

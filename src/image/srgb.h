// The sRGB transfer curve (IEC 61966-2-1), by tables: no pow a pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace whittle {

/// Linear light 0..1 of an sRGB value 0..1.
float linear_from_srgb(float v);
/// sRGB value 0..1 of linear light 0..1.
float srgb_from_linear(float v);

/// Encodes linear light as 8-bit sRGB. Off by at most one level, and only where the exact value
/// lies within a fifth of a level of the border between two.
class SrgbEncoder {
 public:
  SrgbEncoder();
  /// Values outside 0..1 are clamped; NaN is 0.
  uint8_t operator()(float linear) const {
    if (!(linear > 0)) return 0;
    return linear >= 1 ? uint8_t(255) : table_[std::size_t(linear * kSteps + 0.5f)];
  }

 private:
  static constexpr int kSteps = 1 << 13;  ///< 12.92 * 255 / kSteps = 0.4 levels a step at black
  std::array<uint8_t, kSteps + 1> table_;
};

/// The one encoder; it is made at the first call.
const SrgbEncoder& srgb_encoder();

}  // namespace whittle

// What is drawn over a finished picture.
#pragma once

#include <span>

#include "image/picture.h"

namespace whittle {

/// A colour as display values, and how much of it, 0..1.
struct Ink {
  Vec3f color;
  float strength = 0;
};

/// Lays an ink a pixel over the picture (straight alpha over straight alpha). Precondition: as many
/// inks as pixels.
inline void lay_over(std::span<const Ink> inks, Picture& picture) {
  for (size_t i = 0; i < inks.size(); ++i) {
    const Ink& ink = inks[i];
    if (ink.strength <= 0) continue;
    uint8_t* rgba = &picture.rgba[4 * i];
    const float under = float(rgba[3]) / 255 * (1 - ink.strength), alpha = ink.strength + under;
    for (int c = 0; c < 3; ++c)
      rgba[c] = to_8_bits((ink.color[c] * ink.strength + float(rgba[c]) / 255 * under) / alpha);
    rgba[3] = to_8_bits(alpha);
  }
}

}  // namespace whittle

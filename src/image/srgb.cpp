#include "image/srgb.h"

#include <cmath>

namespace whittle {

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float v) {
  return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

const SrgbTable& srgb_table() {
  static const SrgbTable table = [] {
    SrgbTable levels{};
    for (int i = 0; i <= kSrgbSteps; ++i) {
      levels[size_t(i)] = uint8_t(srgb_from_linear(float(i) / kSrgbSteps) * 255 + 0.5f);
    }
    return levels;
  }();
  return table;
}

}  // namespace whittle

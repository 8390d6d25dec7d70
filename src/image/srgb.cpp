#include "image/srgb.h"

#include <cmath>

namespace whittle {

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float v) {
  return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

SrgbEncoder::SrgbEncoder() {
  for (int i = 0; i <= kSteps; ++i) {
    table_[std::size_t(i)] = uint8_t(srgb_from_linear(float(i) / kSteps) * 255 + 0.5f);
  }
}

const SrgbEncoder& srgb_encoder() {
  static const SrgbEncoder encoder;
  return encoder;
}

}  // namespace whittle

#include "image/passes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whittle {
namespace {

template <class ColorOf>
Picture paint(const Frame& frame, ColorOf color_of) {
  Picture picture = Picture::unfilled(frame.width, frame.height);
  for (size_t i = 0; i < frame.hits.size(); ++i) {
    const Vec3f c = frame.hits[i].hit() ? color_of(frame.hits[i]) : Vec3f{};
    uint8_t* p = &picture.rgba[4 * i];
    p[0] = to_8_bits(c.x), p[1] = to_8_bits(c.y), p[2] = to_8_bits(c.z), p[3] = 255;
  }
  return picture;
}

/// Hue, saturation and value, all in 0..1, as red, green and blue.
Vec3f from_hsv(float h, float s, float v) {
  const auto channel = [&](float shift) {
    const float k = std::fmod(shift + h * 6, 6.0f);
    return v - v * s * std::clamp(std::min(k, 4 - k), 0.0f, 1.0f);
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace

Picture depth_pass(const Frame& frame) {
  constexpr float kFarthest = 0.2f;  ///< still apart from the black background
  float near = std::numeric_limits<float>::infinity(), far = -near;
  for (const Hit& h : frame.hits) {
    if (h.hit()) near = std::min(near, h.distance), far = std::max(far, h.distance);
  }
  const float scale = far > near ? (1 - kFarthest) / (far - near) : 0;
  return paint(frame, [&](const Hit& h) {
    const float v = 1 - (h.distance - near) * scale;
    return Vec3f{v, v, v};
  });
}

Picture normal_pass(const Frame& frame) {
  return paint(frame, [](const Hit& h) { return h.normal * 0.5f + Vec3f{0.5f, 0.5f, 0.5f}; });
}

Picture id_pass(const Frame& frame) {
  return paint(frame, [](const Hit& h) {
    // The golden ratio's multiples spread evenly whatever the number of ids; its powers spread the
    // other two components out of step with the hue.
    const double hue = std::fmod(h.id * 0.6180339887498949, 1.0);
    const double value = std::fmod(h.id * 0.7548776662466927, 1.0);
    const double saturation = std::fmod(h.id * 0.5698402909980532, 1.0);
    return from_hsv(float(hue), float(0.45 + 0.5 * saturation), float(0.6 + 0.4 * value));
  });
}

}  // namespace whittle

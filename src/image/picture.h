// A picture: what is shown to people and written to PNG.
#pragma once

#include <cstdint>

#include "base/uninitialized.h"
#include "base/vec.h"

namespace whittle {

/// 8 bits a channel, sRGB for display, straight (not premultiplied) alpha, rows from the top.
struct Picture {
  int width = 0, height = 0;
  UninitializedVector<uint8_t> rgba;  ///< 4 * width * height

  Picture() = default;
  Picture(int w, int h) : width(w), height(h), rgba(4 * size_t(w) * size_t(h), 0) {}
  /// For whoever writes every pixel, on many threads.
  static Picture unfilled(int w, int h) {
    Picture picture;
    picture.width = w, picture.height = h;
    picture.rgba.resize(4 * size_t(w) * size_t(h));
    return picture;
  }
  const uint8_t* at(int x, int y) const {
    return &rgba[4 * (size_t(y) * size_t(width) + size_t(x))];
  }
  uint8_t* at(int x, int y) { return &rgba[4 * (size_t(y) * size_t(width) + size_t(x))]; }
};

/// 8-bit red, green, blue.
struct Rgb8 {
  uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb8&) const = default;
};

/// A value in 0..1 as 8 bits, rounded; what lies outside is clamped and NaN is 0.
constexpr uint8_t to_8_bits(float v) {
  return !(v > 0) ? uint8_t(0) : v >= 1 ? uint8_t(255) : uint8_t(v * 255 + 0.5f);
}

/// The components in 0..1, not decoded.
constexpr Vec3f to_unit(Rgb8 c) {
  return {float(c.r) / 255, float(c.g) / 255, float(c.b) / 255};
}

}  // namespace whittle

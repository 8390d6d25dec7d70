// The camera's rays in single precision, relative to the eye. Colours need no more.
#pragma once

#include <cstddef>

#include "trace/camera.h"

namespace whittle {

/// As many floats as the code for lanes ever takes at once.
inline constexpr size_t kMostFloatLanes = 16;

/// Camera::ray with the eye as origin, so that floats keep their digits far from the world's. The
/// arithmetic is in lanes.inl.
struct PixelRays {
  explicit PixelRays(const Camera& camera)
      : right(to_float(camera.right)),
        up(to_float(camera.up)),
        forward(to_float(camera.forward)),
        half_width(0.5f * float(camera.width)),
        half_height(0.5f * float(camera.height)),
        units_per_pixel(float(2 * camera.half_height / camera.height)),
        orthographic(camera.orthographic) {}

  static Vec3f to_float(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

  Vec3f right, up, forward;
  float half_width, half_height;  ///< pixels
  float units_per_pixel;          ///< perspective: at distance 1 along `forward`
  bool orthographic;
};

}  // namespace whittle

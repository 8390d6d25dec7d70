// The camera's rays in single precision, relative to the eye: all that colours need.
#pragma once

#include <cmath>

#include "trace/camera.h"

namespace whittle {

/// Camera::ray with the eye as origin, so that floats keep their digits far from the world's.
struct PixelRays {
  explicit PixelRays(const Camera& camera)
      : right(to_float(camera.right)),
        up(to_float(camera.up)),
        forward(to_float(camera.forward)),
        half_width(0.5f * float(camera.width)),
        half_height(0.5f * float(camera.height)),
        units_per_pixel(float(2 * camera.half_height / camera.height)),
        orthographic(camera.orthographic) {}

  /// From the middle of the picture's plane to the picture position.
  Vec3f offset(float px, float py) const {
    return right * ((px - half_width) * units_per_pixel) +
           up * ((half_height - py) * units_per_pixel);
  }
  /// The ray's unit direction.
  Vec3f direction(float px, float py) const {
    if (orthographic) return forward;
    const Vec3f v = forward + offset(px, py);
    return v * (1 / std::sqrt(dot(v, v)));
  }
  /// The point at `distance` along the ray of that direction, seen from the eye.
  Vec3f point(Vec3f direction, float distance, float px, float py) const {
    const Vec3f along = direction * distance;
    return orthographic ? offset(px, py) + along : along;
  }

  static Vec3f to_float(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

  Vec3f right, up, forward;
  float half_width, half_height;  ///< pixels
  float units_per_pixel;          ///< perspective: at distance 1 along `forward`
  bool orthographic;
};

}  // namespace whittle

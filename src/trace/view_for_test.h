// Cameras by their numbers, for tests.
#pragma once

#include <vector>

#include "trace/view.h"

namespace whittle {

using CameraNumbers = std::vector<double>;

/// Seven numbers are target, angles in degrees and distance, six are eye and center.
inline ViewOptions view_of(const CameraNumbers& numbers, ViewOptions base = {}) {
  const auto vector_at = [&](size_t i) {
    return Vec3{numbers.at(i), numbers.at(i + 1), numbers.at(i + 2)};
  };
  if (numbers.size() == 7) {
    base.target = vector_at(0), base.rotation_degrees = vector_at(3), base.distance = numbers[6];
  } else {
    base.eye = vector_at(0), base.center = vector_at(3);
  }
  return base;
}

}  // namespace whittle

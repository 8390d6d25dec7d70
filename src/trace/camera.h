// The camera: from pixel positions to rays. Conventions are OpenSCAD's (docs/conventions.md).
#pragma once

#include "kernels/kernels.h"
#include "trace/frame.h"

namespace whittle {

/// A camera with its picture size. right, up and forward are unit and orthogonal.
struct Camera {
  Vec3 eye;
  Vec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  bool orthographic = false;
  double half_height = 1;  ///< perspective: tan(fov / 2); orthographic: model units
  double ortho_reach = 0;  ///< orthographic: rays start this far behind the eye's plane
  int width = 512, height = 512;

  bool operator==(const Camera&) const = default;

  /// The ray through picture position (px, py) in pixels: (0, 0) is the top left corner of the
  /// picture, pixel (i, j) has its centre at (i + 0.5, j + 0.5); pixels are square.
  Ray ray(double px, double py) const {
    using K = Kernels<double>;
    const double s = units_per_pixel();
    const double x = (px - 0.5 * width) * s, y = (0.5 * height - py) * s;
    if (orthographic) return {K::picture_point(eye, right, up, x, y), forward, -ortho_reach};
    return {eye, K::unit3(K::picture_point(forward, right, up, x, y)), 0};
  }

  /// The size of a pixel: perspective: at distance 1 along the axis; orthographic: everywhere.
  double units_per_pixel() const { return 2 * half_height / height; }
};

}  // namespace whittle

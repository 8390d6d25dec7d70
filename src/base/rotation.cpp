#include "base/rotation.h"

#include <cmath>
#include <limits>

#include "base/degrees.h"

namespace whittle {

Affine rotation(double degrees, Vec3 axis) {
  const Vec3 u = normalize(axis);
  if (u == Vec3{}) return {};
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const double c = std::isfinite(degrees) ? cos_degrees(degrees) : kNaN;
  const double s = std::isfinite(degrees) ? sin_degrees(degrees) : kNaN;
  // Rodrigues: R = c I + s [u]x + (1 - c) u u^T
  const double t = 1 - c;
  return {.row = {{c + t * u.x * u.x, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y},
                  {t * u.x * u.y + s * u.z, c + t * u.y * u.y, t * u.y * u.z - s * u.x},
                  {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, c + t * u.z * u.z}},
          .translation = {}};
}

}  // namespace whittle

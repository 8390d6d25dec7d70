// Angles in degrees.
#pragma once

namespace whittle {

/// cos and sin of an angle in degrees, exact at the multiples of 30 and 45 where they are known.
double cos_degrees(double degrees);
double sin_degrees(double degrees);

}  // namespace whittle

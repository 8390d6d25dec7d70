// On which side of a line a point lies, exactly.
#pragma once

#include "base/vec.h"

namespace whittle {

/// Positive if c lies to the left of the line from a to b, negative if to the right, 0 if on it.
/// The sign is exact for coordinates between about 1e-70 and 1e150. (Shewchuk, Adaptive precision
/// floating-point arithmetic, Discrete & Computational Geometry 18, 1997.)
double orientation(Vec2 a, Vec2 b, Vec2 c);

}  // namespace whittle

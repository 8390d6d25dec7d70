// Planes, and the half-spaces that they bound.
#pragma once

#include "base/vec.h"

namespace whittle {

/// A plane n.p = d with unit normal; as a half-space it holds the points with n.p <= d.
struct Plane {
  Vec3 n;
  double d = 0;
};

}  // namespace whittle

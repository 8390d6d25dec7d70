// Turns in degrees, as OpenSCAD's rotate() makes them.
#pragma once

#include "base/affine.h"

namespace whittle {

/// Turns by `degrees` about `axis`, which need not be a unit vector; no axis, no turn. Degrees that
/// are not finite make a map that is not finite.
Affine rotation(double degrees, Vec3 axis);

}  // namespace whittle

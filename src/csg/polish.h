// Rotations as they were before they were printed with six digits.
#pragma once

#include "base/affine.h"

namespace whittle {

/// If the linear part is a rotation, mirrored or not, as six digits print it, then the rotation
/// that was printed: OpenSCAD's angles (z after y after x) in whole hundredths of a degree if those
/// print as this matrix, else the nearest rotation. Anything else, and the translation, stays as it
/// is. No entry changes by more than about 1e-6.
Affine polished(const Affine& map);

}  // namespace whittle

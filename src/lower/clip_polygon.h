// Convex polygons cut by boxes.
#pragma once

#include <vector>

#include "base/vec.h"

namespace whittle {

/// Keeps of a convex polygon what is in the box from -half to half.
void clip_to_box(std::vector<Vec3>& polygon, Vec3 half);

}  // namespace whittle

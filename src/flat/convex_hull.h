// The convex hull of points of the plane.
#pragma once

#include <vector>

#include "flat/polygons.h"

namespace whittle {

/// Counter-clockwise from the leftmost, without corners that lie on its sides; empty if the points
/// have no area. Points must be finite.
Contour hull_contour(std::vector<Vec2> points);

}  // namespace whittle

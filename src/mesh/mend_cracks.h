// Cracks where one side of an edge has a corner that the other side lacks (T-junctions).
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "mesh/edges.h"

namespace whittle {

/// Splits open edges (those with an odd number of triangles) at the corners of others that lie on
/// them to within `reach`, and makes corners of open edges one that are as near to one another.
/// False, and nothing is changed, if that would leave no fewer edges open. Nothing is done either
/// where the search would take long, as in a soup of triangles. About n log n in the number of open
/// edges.
bool mend_cracks(std::span<const Vec3> points, std::vector<Corners>& triangles, double reach);

}  // namespace whittle

// Convex hulls of points in space, by Qhull.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "model/model.h"

namespace whittle {

/// The convex hull of points, with its planes; none if they lie in a plane, as far as can be told
/// (kFlatSolid of their diagonal), or are not finite. Cost: about n log n.
std::optional<Polyhedron> solid_hull(std::span<const Vec3> points);

}  // namespace whittle

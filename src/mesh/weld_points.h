// Welds points that differ only by the digits they were written with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// For every point the number of the first one before it that is no farther away than `tolerance`
/// in any coordinate and was itself not welded to another; its own number if there is none. What is
/// not finite, or so far away that no number tells such a difference, is welded to nothing.
std::vector<uint32_t> weld_points(std::span<const Vec3> points, double tolerance);

}  // namespace whittle

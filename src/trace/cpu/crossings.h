// From what a ray does in each leaf to its crossings of the solid.
#pragma once

#include <span>

#include "trace/cpu/lanes.h"

namespace whittle {

/// Adds the crossings of one ray. `shift`: what t at the ray's own start is more than in `changes`,
/// which are in their order.
void add_crossings(const LaneScene& scene, const LocalRay& ray, double shift,
                   std::span<const LaneChange> changes, RayCrossings& found);

}  // namespace whittle

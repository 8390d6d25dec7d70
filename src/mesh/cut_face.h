// A face of any number of corners as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// Cuts a loop of corners into triangles that run the same way round, and appends them. Every edge
/// of the loop is an edge of one of them, and all others are run through both ways, whatever the
/// loop is like: it need be neither flat nor convex, and may touch or cross itself. Of a flat loop
/// that does not cross itself the triangles cover what it encloses. About n log n.
void cut_face(std::span<const Vec3> points, std::span<const uint32_t> loop,
              std::vector<std::array<uint32_t, 3>>& out);

}  // namespace whittle

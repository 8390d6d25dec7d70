// What becomes of a solid when triangles are left out that are too thin for STL.
#pragma once

#include <cstddef>
#include <vector>

#include "boundary/solid_mesh.h"

namespace whittle {

struct StlLoss {
  size_t triangles = 0;  ///< left out
  size_t holes = 0;      ///< through the solid, that are closed by it
  size_t shells = 0;     ///< parts or hollows of which nothing is left

  bool operator==(const StlLoss&) const = default;
};

/// `is_short`: by edge of a triangle, three a triangle in its order: both ends became one point, so
/// that the triangle is left out. Holes are counted by Euler's formula.
StlLoss loss_of(const SolidMesh& mesh, const std::vector<bool>& is_short);

}  // namespace whittle

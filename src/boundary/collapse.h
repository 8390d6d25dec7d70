// Edges that are only there because planes of a body do not meet in one point to the last digit.
#pragma once

#include <cstddef>

#include "boundary/solid_mesh.h"

namespace whittle {

/// Draws the ends of edges no longer than `length` together, where the mesh stays manifold. How
/// many edges went.
size_t collapse_short_edges(SolidMesh& mesh, double length);

}  // namespace whittle

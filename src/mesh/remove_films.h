// Films: pairs of coincident triangles with nothing between them.
#pragma once

#include <vector>

#include "mesh/edges.h"

namespace whittle {

/// Removes pairs of triangles with the same three corners that are turned opposite ways. Linear but
/// where very many triangles have a corner in common.
void remove_films(std::vector<Corners>& triangles, size_t point_count);

}  // namespace whittle

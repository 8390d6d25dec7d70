// From the parts of a grid to the splits that lead to them.
#pragma once

#include <vector>

#include "subdivide/cell_store.h"
#include "subdivide/wide.h"

namespace whittle {

/// The link of a cell that is split into the parts of a grid, whose links these are, by number. It
/// is split at `split`. What is decided alike on both sides of a split is not split there.
CellLink join_grid(const SplitGrid& grid, std::vector<CellLink> links, CellStore& store,
                   double& split);

}  // namespace whittle

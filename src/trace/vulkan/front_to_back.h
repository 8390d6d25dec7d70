// The cells that a camera can see, in the order in which its rays meet them.
#pragma once

#include <vector>

#include "trace/vulkan/flatten.h"

namespace whittle {

/// An open cell that may be seen: it must be refined before anything is drawn.
struct OpenCellInSight {
  Box box;
  TreePlace place;
  size_t rank;  ///< how many of the cells come before
};

/// No ray meets a later cell before an earlier one. Cells that the tile cannot see may be missing.
/// `region`: the box of all. Writes to `cells` and `open`.
void order_front_to_back(const FlatCells& flat, const Box& region, const Sight& sight,
                         std::vector<VisibleCell>& cells, std::vector<OpenCellInSight>& open);

}  // namespace whittle

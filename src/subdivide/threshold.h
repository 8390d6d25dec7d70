// A threshold that moves: one tree serves all cameras of a renderer, though small cells end where a
// camera says that they are small.
//
// A cell that is small on one side of the threshold and not on the other keeps both of its forms:
// the one in use, and the other as a link, or as the formula to make it from. When the threshold
// moves, each cell that crossed it exchanges the two. What lay below a cell that became small stays
// in memory, and is there again when the cell is no longer small. What was never needed before is
// open, and is refined when a ray meets it. So the tree equals one made afresh with the new
// threshold, and only what is new is refined.
//
// Memory: the cells in use take what `memory` of the settings allows a fresh tree, plus the
// formulas of cells that are split (where small cells are ignored, only of the few that have more
// literals than are expanded at once). What is out of use stays until MovedThreshold::is_crowded
// says that it is too much. A caller that then makes a new tree holds at most `memory` and what one
// more picture needs.
#pragma once

#include "subdivide/subdivide.h"

namespace whittle {

/// What a move did.
struct MovedThreshold {
  uint64_t cells = 0;   ///< in use, refined or open
  uint64_t opened = 0;  ///< of them, those that are no longer small,
  uint64_t closed = 0;  ///< and those that became small
  /// More than three quarters of all cells are out of use, or all together take more than `memory`:
  /// it is time to make a new tree.
  bool is_crowded = false;
};

/// From now on a cell is small if `is_small` says so. Precondition: the tree was made with some
/// `is_small`, and nobody looks at it meanwhile. Runs on all threads of `workers`.
MovedThreshold move_threshold(const CellTree& tree, IsSmall is_small, const Workers& workers);

}  // namespace whittle

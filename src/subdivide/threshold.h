// A threshold that moves: one tree serves all cameras of a renderer, though small cells end where a
// camera says that they are small.
//
// Every cell that would be another one across the threshold keeps what it would be: a link, or, as
// long as nobody knows, the formula to find it out from. When the threshold moves, cells that
// crossed it change places with what they are across. What lay below a cell that became small stays
// in memory and is there again when the cell is no longer small; what was never needed before is
// open and is refined when somebody looks. So the tree is what one made afresh with that threshold
// would be, and only what is new is refined.
//
// Memory: what is in use takes what `memory` of the settings lets a fresh tree take, and formulas
// of cells that are split besides (where small cells are ignored, only those of the few that have
// more literals than are expanded at once). What is out of use stays until
// MovedThreshold::is_crowded says that it is too much: who heeds that holds at most `memory` and
// what one more picture needs.
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

// Subdivision: from a formula and a box to cells.
//
// Based on: the paper, section 2 (binary subdivision, each cell's tree simplified from its
// parent's). What we changed: literals are half-spaces; a leaf holds up to k of them, simplified
// completely by its truth table where there are at most six; no leaf is dropped unless asked for;
// sub-trees are built in parallel, and the result does not depend on the number of threads.
#pragma once

#include <functional>

#include "subdivide/cells.h"

namespace whittle {

enum class SplitRule {
  kLongest,  ///< the longest edge, in the middle
  kXyz,      ///< X, Y, Z in turn, in the middle: the paper's
};

enum class LeafRule {
  kHalfSpaces,  ///< at most leaf_size half-spaces
  kPrimitives,  ///< the paper's: at most leaf_size primitives, or a union of any number
};

struct SubdivideSettings {
  uint32_t leaf_size = 6;
  SplitRule split = SplitRule::kLongest;
  LeafRule leaf = LeafRule::kHalfSpaces;
  /// The smallest useful cell: one with (edge / region's edge)^2 * literals below this is not split
  /// any more. The square is about the share of rays that meet the cell, the literals are what
  /// each of them costs there; where surfaces meet for good, splitting soon costs more than it
  /// saves (measured: docs/decisions/0007-smallest-useful-cell.md). Not used if `is_small` is set.
  double least_use = 1.0 / 4096;
  /// No cell's edge gets smaller than this share of the region's longest edge, whatever is in it.
  double smallest_edge = 1.0 / 16384;
  /// If set: a cell (world coordinates) for which this holds is not split any more. The paper's
  /// pixel threshold makes cells depend on the camera.
  std::function<bool(const Box&)> is_small;
  /// Drop the leaves that `is_small` stopped, as the paper did.
  bool ignore_small = false;
  /// Cells that there may be; then none is split any more, and leaves have longer formulas
  /// instead. The picture is the same. A leaf of many literals counts as several cells, and
  /// what is open at the end comes on top. At most kMostCells (docs/decisions/0010-limits.md).
  size_t max_cells = 20'000'000;
  int threads = 0;  ///< 0: all
};

/// Numbers of what is in the cells have 32 bits.
inline constexpr size_t kMostCells = size_t(1) << 28;

/// How far a cell is grown before anything is classified against it, as a share of the region's
/// longest edge. Far above the rounding of a ray's entry and exit (1e-15), far below anything seen;
/// it puts a surface that lies exactly on a split into both cells, so no ray slips between them.
inline constexpr double kCellMargin = 1e-10;

/// Never fails; time and memory are bounded by max_cells. `scene` must outlive the result's use.
CellTree subdivide(const Scene& scene, const SubdivideSettings& settings);

}  // namespace whittle

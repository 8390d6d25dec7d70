// Subdivision: from a formula and a box to cells.
//
// Based on: the paper, section 2 (binary subdivision, each cell's tree simplified from its
// parent's). What we changed: literals are half-spaces; a leaf holds up to k of them, simplified
// completely by its truth table where there are at most six; no leaf is dropped unless asked for;
// cells are refined when a ray first meets them, or all at once on all threads. The cells are the
// same either way.
#pragma once

#include <functional>

#include "base/workers.h"
#include "subdivide/cells.h"

namespace whittle {

/// Cells are cut in the middle, and these say along which axis.
enum class SplitRule {
  kLongest,  ///< the longest edge; a cell that is mostly empty is cut beside what is in it
  kXyz,      ///< X, Y, Z in turn: the paper's
  kOctree,   ///< all three at once, as octrees do; the formula is simplified for the eight parts
             ///< only
  kCost,     ///< that along which rays will meet the fewest literals
};

/// Which axis is cut of a cell of that size, if its formula is not asked.
inline int split_axis(Vec3 size, SplitRule rule, uint32_t depth) {
  if (rule == SplitRule::kXyz || rule == SplitRule::kOctree) return int(depth % 3);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

enum class LeafRule {
  kHalfSpaces,  ///< at most leaf_size half-spaces
  kPrimitives,  ///< the paper's: at most leaf_size primitives, or a union of any number
};

/// A cell is split if that is expected to save the rays that meet it more than it takes
/// (docs/decisions/0014-leaf-size.md).
inline constexpr uint32_t kAutoLeafSize = 0;

/// Whether a cell is small, by its box.
using IsSmall = std::function<bool(const Box&)>;

/// How far cells are grown, as a share of the region's longest edge. Far above the rounding of a
/// ray's entry and exit in double (1e-15), and far below anything that is seen, even of a small
/// part in a large model. A surface that lies exactly on a split is so in both cells, and no ray
/// slips between them.
inline constexpr double kCellMargin = 1e-12;

struct SubdivideSettings {
  /// Half-spaces (or primitives) that a leaf may hold, or kAutoLeafSize.
  uint32_t leaf_size = kAutoLeafSize;
  /// kAutoLeafSize: how many rays there will be, about, if all of the region is seen as closely as
  /// what is to be looked at.
  double rays = 512.0 * 512;
  SplitRule split = SplitRule::kLongest;
  LeafRule leaf = LeafRule::kHalfSpaces;
  /// The smallest useful cell: one with (edge / region's edge)^2 * literals below this is not split
  /// any more. The square is about the share of rays that meet the cell, the literals are what
  /// each of them costs there; where surfaces meet for good, splitting soon costs more than it
  /// saves (measured: docs/decisions/0007-smallest-useful-cell.md). Not used if `is_small` is set,
  /// or with kAutoLeafSize.
  double least_use = 1.0 / 4096;
  /// No cell's edge gets smaller than this share of the region's longest edge, whatever is in it.
  /// Not used with kAutoLeafSize.
  double smallest_edge = 1.0 / 16384;
  /// If set: a cell (world coordinates) for which this holds is not split any more. The paper's
  /// pixel threshold makes cells depend on the camera; threshold.h moves it. Pure.
  IsSmall is_small;
  /// Drop the leaves that `is_small` stopped, as the paper did.
  bool ignore_small = false;
  /// What the cells may take, bytes. Where it runs out cells are not split any more, and leaves
  /// have longer formulas instead; the picture is the same. Each cell hands its share on to its
  /// parts, so that the cells do not depend on the order in which they are refined. If the formula
  /// as a whole takes more, that is what is taken (docs/decisions/0010-limits.md).
  size_t memory = size_t(1) << 30;
  /// How far a cell is grown before anything is classified against it: its leaf is right there,
  /// too. A share of the region's longest edge, at least kCellMargin.
  double margin = kCellMargin;
  int threads = 0;  ///< 0: all
};

/// A tree of one open cell, to be refined where somebody looks. `scene` must outlive the tree.
/// What is prepared for that is made on all workers, if there are any.
CellTree open_cells(const Scene& scene, const SubdivideSettings& settings,
                    const Workers* workers = nullptr);

/// Refines the cells with long formulas, on all threads. They are the ones at the top of the tree,
/// which every ray meets first.
void refine_top(const CellTree& tree, const Workers& workers);

/// Refines the cells level by level, on all threads, until enough are open to keep these busy.
void refine_levels(const CellTree& tree, const Workers& workers);

/// Refines all that is open, on all threads. Never fails; time and memory are bounded by the
/// settings' `memory`.
void refine_all(const CellTree& tree, const Workers& workers);

/// All cells at once.
CellTree subdivide(const Scene& scene, const SubdivideSettings& settings);

}  // namespace whittle

// A cell with very many operands is split many times at once: each operand goes straight to the
// parts that its box meets, instead of being looked at again on every level.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "lower/scene.h"
#include "subdivide/subdivide.h"

namespace whittle {

/// The parts that a box has after some splits in the middle: a grid.
struct SplitGrid {
  std::vector<int> axes;                    ///< that are split, one after the other
  std::array<std::vector<double>, 3> cuts;  ///< along each axis, the box's own sides included

  size_t size() const;
  /// Parts are numbered x first, then y, then z.
  Box part(size_t number) const;
};
SplitGrid make_grid(const Box& box, int splits, SplitRule rule, uint32_t depth);

/// Calls body(first, last, worker) for parts that together are 0 <= i < n.
using Loop = std::function<void(size_t n, size_t grain,
                                const std::function<void(size_t, size_t, size_t)>& body)>;

/// Operands of the formula's outermost group; 0 if it is no group.
size_t operand_count(std::span<const Token> formula);

/// For each part of the grid a formula that is right in it, grown by `margin`: the operands that
/// may matter there, in their order. Empty if the operands cannot be told apart by their boxes.
std::vector<Formula> deal_operands(const Scene& scene, std::span<const Token> formula,
                                   const SplitGrid& grid, double margin, const Loop& loop);

}  // namespace whittle

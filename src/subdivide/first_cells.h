// The first cells of the searches for a solid's bounds, which are the same in every direction. Of a
// large model they are most of the work.
#pragma once

#include <array>
#include <vector>

#include "base/workers.h"
#include "subdivide/simplify.h"

namespace whittle {

int longest_axis(const Box& box);

/// Both parts of a box. It is not cut in the middle, where symmetrical models have faces, which
/// then are in both.
std::array<Box, 2> split(const Box& box, int axis);

/// Simplifies a formula for a box; what is short gets all its primitives expanded.
Truth simplify_for(const Box& box, const Formula& around, const Scene& scene,
                   Simplifier& simplifier, Formula& out);

/// Whether a formula is too long to be looked at as a union of polytopes. Its cell is split.
bool is_large(const Simplifier::Size& size);

class FirstCells {
 public:
  struct Cell {
    Box box;
    size_t parent = 0;
    size_t parts = 0;  ///< the first of the two that it is split into; 0: it is not
    Truth truth = Truth::kVaries;
    Formula formula = {};  ///< simplified for the box, if that varies in it
    Simplifier::Size size = {};
  };

  /// Made on all workers.
  FirstCells(const Scene& scene, const UnitBoxes& boxes, const Box& start, const Workers& workers);

  /// The whole box is in front.
  const Cell& operator[](size_t i) const { return cells_[i]; }
  /// What a cell's formula was simplified from.
  const Formula& around(size_t i) const {
    return i == 0 ? scene_.formula : cells_[cells_[i].parent].formula;
  }

 private:
  void add_parts(size_t i);

  const Scene& scene_;
  std::vector<Cell> cells_;
};

}  // namespace whittle

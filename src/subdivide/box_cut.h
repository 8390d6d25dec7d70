// Where to cut a cell in which nearly all is in a small part: beside the boxes of what is there,
// instead of in the middle again and again.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lower/scene.h"

namespace whittle {

/// A plane that parts a cell.
struct Cut {
  int axis = 0;
  double at = 0;
};

class BoxCutter {
 public:
  /// `margin`: how far cells are grown before anything is classified, local units.
  BoxCutter(const Scene& scene, double margin) : scene_(scene), margin_(margin) {}

  /// The cut next to a box of an operand with which rays through the cell meet the fewest literals,
  /// as far as boxes tell, unless `middle` is much better. None where the operands fill the cell,
  /// which is found out in no time; the rest takes n log n for n operands.
  std::optional<Cut> cut(std::span<const Token> formula, const Box& cell, Cut middle);

 private:
  /// What some literals say is said in this box.
  struct Active {
    Box box;
    uint32_t literals;
  };
  /// One side of such a box, and the literals of all boxes up to it, itself included.
  struct Bound {
    double at;
    double literals;
  };
  bool is_filled(std::span<const Token> formula, const Box& cell) const;
  void find_active(std::span<const Token> formula, const Box& cell);
  void sort_bounds(int axis);
  double cost(const Box& cell, Cut cut) const;

  const Scene& scene_;
  double margin_;
  std::vector<Box> reach_;  ///< by a group's index, outside of which the group is absorbed
  std::vector<Active> active_;
  std::vector<Bound> lows_, highs_;  ///< along one axis
};

}  // namespace whittle

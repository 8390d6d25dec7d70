// Where to cut a cell whose content fills only a small part of it: beside the boxes of the content,
// instead of in the middle many times over.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lower/scene.h"

namespace whittle {

/// A plane that cuts a cell in two.
struct BoxCut {
  int axis = 0;
  double at = 0;
};

class BoxCutter {
 public:
  /// `margin`: how far cells are grown before anything is classified, local units.
  BoxCutter(const Scene& scene, double margin) : scene_(scene), margin_(margin) {}

  /// Of the cuts beside operands' boxes, the one with which rays through the cell meet the fewest
  /// literals, as far as boxes tell. None if `middle` is much better, or if the operands fill the
  /// cell (which is found out at once). Takes n log n time for n operands.
  std::optional<BoxCut> cut(std::span<const Token> formula, const Box& cell, BoxCut middle);

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
  double cost(const Box& cell, BoxCut cut) const;

  const Scene& scene_;
  double margin_;
  std::vector<Box> reach_;  ///< by a group's index, outside of which the group is absorbed
  std::vector<Active> active_;
  std::vector<Bound> lows_, highs_;  ///< along one axis
};

}  // namespace whittle

// Finds the points along a segment.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/polygons.h"

namespace whittle {

class PointTree {
 public:
  /// Points must be finite.
  explicit PointTree(std::vector<Vec2> points);

  /// Numbers of the points no farther than `margin` from the segment, in no meaningful order.
  void near_segment(Vec2 a, Vec2 b, double margin, std::vector<uint32_t>& found) const;

 private:
  struct Node {
    Rect box;
    uint32_t begin, end;  ///< into order_
    uint32_t left;        ///< the child before `left + 1`; 0: none
  };

  std::vector<Vec2> points_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace whittle

// The corners of a solid, sorted so that those that lie far out in a direction are found at once.
//
// A tree of cylinders: every node knows an axis, about normal to the surface that its corners lie
// on, how far they reach along it, and how far from it. On a smooth surface the cylinders get flat
// faster than they get small, so that a search near a plane that touches the surface meets a few
// nodes of each size; boxes along x, y and z would not do that.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace whittle {

class CornerTree {
 public:
  struct Corner {
    Vec3 place;
    Vec3 normal;          ///< about outward; any vector is right, a good one makes searches fast
    uint32_t number = 0;  ///< for the caller
  };

  /// All places must be finite.
  explicit CornerTree(std::vector<Corner> corners);

  /// Calls `visit(corner)` for all corners but those that `is_wanted` excludes. It is asked about
  /// sets of corners, with an upper bound of their heights and a lower bound of their distances
  /// from `from`; its answers may change as corners are visited. Heights are along `n`, a unit
  /// vector, above the origin.
  template <class IsWanted, class Visit>
  void search(Vec3 n, Vec3 from, const IsWanted& is_wanted, const Visit& visit) const;

 private:
  struct Node {
    uint32_t begin = 0, end = 0;  ///< its corners
    uint32_t second = 0;          ///< the second child; the first one follows the node; 0: none
    Vec3 middle, axis;
    double lo = 0, hi = 0;  ///< along the axis from the middle
    double radius = 0;      ///< about the axis
    double reach = 0;       ///< from the middle, in any direction
    double rounding = 0;    ///< of heights
  };

  void split(uint32_t node);
  double most_height(const Node& node, Vec3 n) const;

  std::vector<Corner> corners_;
  std::vector<Node> nodes_;
};

inline double CornerTree::most_height(const Node& node, Vec3 n) const {
  const double along = dot(n, node.axis);
  const double across = std::sqrt(std::max(0.0, 1 - along * along));
  return dot(n, node.middle) + std::max(along * node.lo, along * node.hi) + across * node.radius +
         node.rounding;
}

template <class IsWanted, class Visit>
void CornerTree::search(Vec3 n, Vec3 from, const IsWanted& is_wanted, const Visit& visit) const {
  // Every split halves the corners, of which there are less than 2^32; two nodes for each.
  uint32_t open[80];
  int depth = 0;
  if (!nodes_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const uint32_t i = open[--depth];
    const Node& node = nodes_[i];
    const double distance = length(node.middle - from) - node.reach - node.rounding;
    if (!is_wanted(most_height(node, n), std::max(0.0, distance))) continue;
    if (node.second == 0) {
      for (uint32_t c = node.begin; c < node.end; ++c) visit(corners_[c]);
      continue;
    }
    // The higher one first: what is found there excludes more.
    const uint32_t first = i + 1;
    const bool second_is_higher =
        most_height(nodes_[node.second], n) > most_height(nodes_[first], n);
    open[depth++] = second_is_higher ? first : node.second;
    open[depth++] = second_is_higher ? node.second : first;
  }
}

}  // namespace whittle

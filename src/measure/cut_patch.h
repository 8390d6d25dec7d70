// A quadric's surface in a box where it is a graph over two of the axes, and leaves the box through
// one end of the third along a curve that is a graph itself.
//
// From that curve to the side of the box where the graph is within, Gauss's rule is applied along
// lines, and across them to their sums. The curve is analytic, too (it is a conic), and with it the
// sums, so the errors of both are known.
#pragma once

#include <array>
#include <optional>

#include "measure/graph_patch.h"

namespace whittle {

class CutPatch {
 public:
  /// Of a patch that leaves its box; lines run along `axis`, one of the base. None unless all of
  /// the above is proved.
  static std::optional<CutPatch> make(const GraphPatch& surface, int axis);

  struct Bound {
    size_t points = 0;
    double volume = 0;
    int worst_axis = 0;
    std::array<size_t, 2> ellipses{};  ///< along lines, across them
  };
  Bound bound(const GaussTable& gauss, size_t n) const;

  /// As those of GraphPatch.
  Moments moments(const GaussRule& rule) const;
  Moments bounds(const GaussTable& gauss, const Bound& bound, Vec3 center) const;

 private:
  CutPatch(const GraphPatch& surface, const GraphPatch& curve) : s_(surface), c_(curve) {}
  /// For coordinates of these moduli: along lines, across them.
  GraphPatch::Reach reach(double along, double across) const {
    return along_ == s_.i_ ? s_.reach(along, across) : s_.reach(across, along);
  }
  /// How far from the middle the curve is, at most, with complex coordinates in an ellipse; in
  /// halves of the box. Infinite if it is not known.
  double curve_reach(size_t ellipse) const;
  /// The square of the gradient over D, at most. Infinite if it may have no root.
  double most_lean(Vec3 way, const GraphPatch::Reach& reach) const;

  GraphPatch s_, c_;
  int along_ = 0, across_ = 0;
  double end_ = 0;   ///< where the surface leaves, along its axis
  double side_ = 1;  ///< the graph is within from the curve to this side, -1 or 1
};

}  // namespace whittle

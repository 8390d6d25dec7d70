// A quadric's surface in a box, where it is a graph over two of the axes.
//
// Along the third axis f(x, y, z) = 0 is solved by z = level - phi / (beta + sign sqrt(D)), where
// phi and D are polynomials of degree two in x and y, and beta is linear. While D stays away from
// zero that is an analytic function, for complex x and y too. So Gauss's rules integrate it with an
// error that is known (gauss.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "measure/gauss.h"
#include "measure/quadric_cell.h"

namespace whittle {

class GraphPatch {
 public:
  /// About the origin of a box, along an axis. None unless it is proved that f = 0 is no more than
  /// one graph in the box.
  static std::optional<GraphPatch> make(const Quadric& f, Vec3 half, int axis);

  /// Over all of the box's base the surface is between these along the axis.
  double low() const { return level_ - spread_; }
  double high() const { return level_ + spread_; }
  /// The surface does not reach the box's ends along the axis.
  bool is_within() const { return low() > -half_[k_] && high() < half_[k_]; }

  /// How wrong the volume below it can be by n x n points, and the axis that is to blame. Only if
  /// it is within.
  struct Bound {
    size_t points = 0;
    double volume = 0;
    int worst_axis = 0;
    std::array<size_t, 2> ellipses{};  ///< by which it is proved, along each axis of the base
  };
  Bound bound(const GaussTable& gauss, size_t n) const;

  /// Of the part of the box in which f <= 0, about its middle.
  Moments moments(const GaussRule& rule) const;
  /// What they may be off; `center` is the box's own place, about which all others are.
  Moments bounds(const GaussTable& gauss, const Bound& bound, Vec3 center) const;

 private:
  friend class CutPatch;

  /// Where the surface is along the axis, at a point of the base.
  double at(Vec3 p) const;
  /// Of f's second-degree part, as a matrix.
  double norm() const;

  /// Without the constant; coordinates are those of the box's base, in halves of it.
  struct Polynomial {
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    double at(double s, double t) const {
      return x * s + y * t + xx * s * s + xy * s * t + yy * t * t;
    }
    /// Of the modulus, for complex s and t of these moduli.
    double most(double s, double t) const;
  };
  /// What is known for complex coordinates of these moduli.
  struct Reach {
    bool is_analytic = false;
    double rise = 0;     ///< the graph's distance from `level`
    double least_d = 0;  ///< of the real part of D
  };
  Reach reach(double s, double t) const;

  Quadric f_;
  Vec3 half_;
  int k_ = 0, i_ = 0, j_ = 0;
  double level_ = 0, spread_ = 0;
  double d0_ = 0, root_ = 0, sign_ = 1;  ///< D in the middle, sqrt(D), the sign of f's slope
  Polynomial phi_, d_;
  double beta_x_ = 0, beta_y_ = 0;
  std::array<std::array<Reach, kEllipses.size()>, 2> reaches_;
};

}  // namespace whittle

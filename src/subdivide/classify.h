// Three-valued, conservative classification of half-spaces and primitives against a cell.
//
// "Outside" and "inside" are proofs: they hold at every point of the cell grown by its margin, with
// the rounding of this test and of any ray's arithmetic included. "Crosses" may be wrong and then
// only costs time.
#pragma once

#include <cmath>

#include "lower/scene.h"

namespace whittle {

enum class Side : uint8_t { kOutside, kInside, kCrosses };

/// A box as centre and half size, grown by the margin.
struct CellBox {
  Vec3 center, half;

  CellBox(const Box& box, double margin)
      : center(box.center()), half(box.size() * 0.5 + Vec3{margin, margin, margin}) {}
};

/// Rounding of one evaluation in double, as a share of the magnitudes of its terms.
inline constexpr double kRoundingSlack = 1e-14;

/// A curved surface that holds its centre (f.c < 0: ellipsoids, cylinders, cones), as
/// rho(q) <= |w.q + r|, where rho(q)^2 = q.Pq is f's square completed and P has no negative
/// eigenvalue: rho is a norm, and so convex.
///
/// Outside: rho is nowhere below its tangent at the cell's middle, and that is linear. Inside:
/// where w.q + r > 0 all over the cell, the half-space is convex there, and it holds the cell if it
/// holds the corners.
inline Side classify_curved(const Kernels<double>::Quadric& f, Vec3 m, Vec3 h) {
  using K = Kernels<double>;
  const Vec3 am = K::quadric_apply(f, m);
  const double value = dot(am, m) + 2 * dot(f.b, m) + f.c;
  const Vec3 reach = abs(m) + h;
  const bool is_cone = !(f.b == Vec3{});
  const double r = is_cone ? std::sqrt(-f.c) : 0;
  const Vec3 w = is_cone ? f.b * (-1 / r) : Vec3{};
  // |x.Py| <= trace P |x| |y|.
  const double squares = f.diag.x + f.diag.y + f.diag.z + dot(w, w);
  const double magnitude = squares * dot(reach, reach);

  if (value > 0) {
    const Vec3 pm = am + w * dot(w, m);
    const double square = dot(pm, m);
    if (!is_cone) {
      // rho - slope.h > sqrt(-c), times rho and squared.
      const double low = square - dot(abs(pm), h) - kRoundingSlack * magnitude;
      return low > 0 && low * low > -f.c * square * (1 + kRoundingSlack) ? Side::kOutside
                                                                         : Side::kCrosses;
    }
    // Beyond the surface, and beyond its mirror image behind the apex. Written so that a NaN
    // crosses.
    const double rho = std::sqrt(square), along = dot(w, m) + r;
    const double slack = kRoundingSlack * (magnitude / rho + dot(abs(w), reach) + r);
    const Vec3 slope = pm * (1 / rho);
    return rho - along - dot(abs(slope - w), h) > slack &&
                   rho + along - dot(abs(slope + w), h) > slack
               ? Side::kOutside
               : Side::kCrosses;
  }
  double along_square = -f.c;
  if (is_cone) {
    const double along = dot(w, m) + r, along_reach = dot(abs(w), reach) + r;
    if (!(along - dot(abs(w), h) > kRoundingSlack * along_reach)) return Side::kCrosses;
    along_square = along_reach * along_reach;
  }
  // f at the farther of two corners that lie opposite one another, for the four such pairs.
  const Vec3 half_gradient = am + f.b;
  const double gx = 2 * half_gradient.x * h.x, gy = 2 * half_gradient.y * h.y,
               gz = 2 * half_gradient.z * h.z;
  const double yz = 2 * f.off.x * h.y * h.z, xz = 2 * f.off.y * h.x * h.z,
               xy = 2 * f.off.z * h.x * h.y;
  const double corners = K::pmax(
      K::pmax(xy + xz + yz + std::fabs(gx + gy + gz), xy - xz - yz + std::fabs(gx + gy - gz)),
      K::pmax(xz - xy - yz + std::fabs(gx - gy + gz), yz - xy - xz + std::fabs(gy + gz - gx)));
  const double farthest =
      value + f.diag.x * h.x * h.x + f.diag.y * h.y * h.y + f.diag.z * h.z * h.z + corners;
  return farthest < -kRoundingSlack * (magnitude + along_square) ? Side::kInside : Side::kCrosses;
}

inline Side classify(const HalfSpace& h, const CellBox& cell) {
  using K = Kernels<double>;
  const Vec3 m = cell.center - h.center;
  double low, high;
  if (h.is_plane()) {
    const double value = 2 * dot(h.f.b, m);
    const double spread = 2 * dot(abs(h.f.b), cell.half);
    low = value - spread, high = value + spread;
  } else if (h.kind == SurfaceKind::kSphere) {
    const K::Vec2 range = K::sphere_range(h.f.diag.x, h.f.c, m, cell.half, kRoundingSlack);
    low = range.x, high = range.y;
  } else {
    return classify_curved(h.f, m, cell.half);
  }
  // Written so that a NaN crosses.
  if (low > 0) return Side::kOutside;
  if (high < 0) return Side::kInside;
  return Side::kCrosses;
}

inline Side classify(const Scene& scene, Literal literal, const CellBox& cell) {
  const Side side = classify(scene.half_spaces[literal >> 1], cell);
  if (side == Side::kCrosses || !(literal & 1)) return side;
  return side == Side::kInside ? Side::kOutside : Side::kInside;
}

/// What holds all of a literal in a cell, q relative to the cell's middle: n.q + value <= 0.
struct Bound {
  Vec3 n;
  double value;
  bool is_plane;  ///< it is all that the literal says, and no more
};

/// A plane's own, or the tangent of a curved surface's norm (see classify_curved). Where there is
/// none, one that says nothing.
inline Bound outer_bound(const Scene& scene, Literal literal, const CellBox& cell) {
  using K = Kernels<double>;
  const HalfSpace& h = scene.half_spaces[literal >> 1];
  const bool complement = literal & 1;
  const Vec3 m = cell.center - h.center;
  if (h.is_plane()) {
    const Vec3 n = h.f.b * (complement ? -2.0 : 2.0);
    return {n, dot(n, m), true};
  }
  const Bound nothing{{}, -kInfinity, false};
  if (complement) return nothing;
  const double r = std::sqrt(-h.f.c);
  const Vec3 w = h.f.b * (-1 / r);
  const double along = dot(w, m) + r;
  if (!(along - dot(abs(w), cell.half) > 0)) return nothing;
  const K::Quadric p{h.f.diag + Vec3{w.x * w.x, w.y * w.y, w.z * w.z},
                     h.f.off + Vec3{w.y * w.z, w.x * w.z, w.x * w.y},
                     {},
                     0};
  const Vec3 pm = K::quadric_apply(p, m);
  const double rho = std::sqrt(dot(pm, m));
  // As a length: f's slope is about 2 r where f is a length.
  const double length = 2 * r;
  if (!(rho > 0)) return nothing;
  return {(pm / rho - w) * length, (rho - along) * length, false};
}

/// Whether no point of the cell, of half size h, is in both by more than the margin. Proved by a
/// weighted sum of the two bounds that is above zero all over the cell. The least value of the sum
/// is a concave function of the weight, with kinks where a coordinate cancels.
inline bool are_apart(const Bound& a, const Bound& b, Vec3 h, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(a.n[axis] * b.n[axis] < 0)) continue;
    const double weight = -a.n[axis] / b.n[axis];
    if (a.value + weight * b.value - dot(abs(a.n + b.n * weight), h) > (1 + weight) * margin)
      return true;
  }
  return false;
}

/// A primitive by its bounds alone, before any of its faces is looked at.
inline Side classify_bounds(const Unit& unit, const CellBox& cell) {
  const Box& b = unit.outer;
  for (int axis = 0; axis < 3; ++axis)
    if (cell.center[axis] + cell.half[axis] < b.lo[axis] ||
        cell.center[axis] - cell.half[axis] > b.hi[axis])
      return Side::kOutside;
  if (unit.inner_radius > 0 &&
      length(abs(cell.center - unit.inner_center) + cell.half) < unit.inner_radius)
    return Side::kInside;
  return Side::kCrosses;
}

}  // namespace whittle

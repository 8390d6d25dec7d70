// Three-valued, conservative classification of half-spaces and primitives against a cell.
//
// "Outside" and "inside" are proofs: they hold at every point of the cell grown by its margin, with
// the rounding of this test and of any ray's arithmetic included. "Crosses" may be wrong and then
// only costs time.
#pragma once

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

inline Side classify(const HalfSpace& h, const CellBox& cell) {
  using K = Kernels<double>;
  const Vec3 m = cell.center - h.center;
  double low, high;
  if (h.is_plane()) {
    const double value = 2 * dot(h.f.b, m);
    const double spread = 2 * dot(abs(h.f.b), cell.half);
    low = value - spread, high = value + spread;
  } else {
    const K::Vec2 range = h.kind == SurfaceKind::kSphere
                              ? K::sphere_range(h.f.diag.x, h.f.c, m, cell.half, kRoundingSlack)
                              : K::quadric_range(h.f, m, cell.half, kRoundingSlack);
    low = range.x, high = range.y;
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

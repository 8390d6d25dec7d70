// How large a primitive is where it stands: what decides which of its surfaces are one with others
// (docs/conventions.md, Coincidence).
#pragma once

#include <algorithm>
#include <span>

#include "base/box.h"
#include "base/plane.h"

namespace whittle {

/// Lengths in the units of the space that was mapped into.
struct Extent {
  Vec3 center;        ///< the middle of the outline
  double radius = 0;  ///< the outline lies within this of the centre; infinite for a half-space
  double width = 0;   ///< about twice the radius of the ball that fits in about the centre; never
                      ///< above twice the true one's for squashed curves; infinite for a half-space
};

/// Of the conjunction of planes whose corners are given; without corners it is a half-space. The
/// map is not singular.
Extent flat_extent(std::span<const Vec3> corners, std::span<const Plane> planes, const Affine& map);

/// The same seen from a region: what is larger than the region's ball counts as that ball.
/// An empty region changes nothing.
inline Extent within(const Extent& extent, const Box& region) {
  if (region.is_empty()) return extent;
  const double radius = 0.5 * region.diagonal();
  return extent.radius <= radius ? extent : Extent{region.center(), radius, extent.width};
}

/// The extent of several: a ball around theirs, and the width of the thinnest.
Extent united(const Extent& a, const Extent& b);

/// How near another surface must be to a surface of this primitive to be the same: the model's
/// tolerance, but never more than a thousandth of the primitive's own width, so that none is eaten,
/// and never less than what rounding can tell apart (see ray_tolerance()), so that equal faces are
/// one.
inline double own_tolerance(double model_tolerance, const Extent& extent, double ray_tolerance) {
  return std::max(ray_tolerance, std::min(model_tolerance, 1e-3 * extent.width));
}

/// Surfaces that are no farther apart than this were written to be the same. Its divisor and the
/// next one are chosen so that no round decimal number is exactly at the limit, where rounding
/// would decide: people write round numbers.
inline double equal_tolerance(double own_tolerance, double ray_tolerance) {
  return std::max(ray_tolerance, own_tolerance / 1500);
}

/// Surfaces that were written to be the same lie on an earlier surface all at once or not at all.
/// The tolerance for that is the largest of theirs, but never more than a 15th of the width of the
/// thinnest primitive.
inline double joint_tolerance(double largest_tolerance, double thinnest, double ray_tolerance) {
  return std::max(ray_tolerance, std::min(largest_tolerance, thinnest / 15));
}

}  // namespace whittle

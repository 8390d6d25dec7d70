// Points where three planes meet, and what can be asked about them. All answers are exact.
//
// Each point knows its coordinates rounded down to a multiple of 2^-34, which settles nearly all
// questions; the names of its planes settle the rest.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "boundary/exact_plane.h"

namespace whittle {

struct ExactPoint {
  static constexpr int kFractionBits = 34;

  std::array<int64_t, 3> floor{};  ///< of the coordinates times 2^kFractionBits
  std::array<uint32_t, 3> planes{};
  bool is_whole = false;  ///< `floor` is the point itself
};

/// A point as far as doubles know it: `y` is no farther off than `error` in any coordinate.
struct ApproximatePoint {
  std::array<uint32_t, 3> planes{};
  Vec3 y;
  double error = 0;
};

/// A point's coordinates as fractions: x / w.
struct HomogeneousPoint {
  std::array<WideInt<3>, 3> x;  ///< 188 bits
  WideInt<3> w;                 ///< 161 bits, positive
};

/// What knows the planes. Numbers of planes are those of the table, which must outlive it.
class ExactGeometry {
 public:
  explicit ExactGeometry(const PlaneTable& planes) : planes_(planes) {}

  size_t plane_count() const { return planes_.size(); }
  const ExactPlane& plane(uint32_t number) const { return planes_[number]; }
  const RoundedPlane& rounded(uint32_t number) const { return planes_.rounded(number); }

  /// Precondition: the planes meet in one point, in or near the region.
  ExactPoint meet(uint32_t a, uint32_t b, uint32_t c) const;
  ApproximatePoint about(uint32_t a, uint32_t b, uint32_t c) const;
  HomogeneousPoint homogeneous(const std::array<uint32_t, 3>& planes) const;

  /// On which side of a plane a point is; 0: on it.
  PlaneSide side(const ExactPoint& point, uint32_t plane) const;
  PlaneSide side(const ApproximatePoint& point, uint32_t plane) const {
    const RoundedPlane& p = rounded(plane);
    const double value = dot(p.n, point.y) - p.d;
    // The components of a normal add up to no more than 3; the rest is rounding here.
    const double error =
        3 * point.error + 0x1p-49 * (2 * max_component(abs(point.y)) + std::fabs(p.d));
    if (value > error) return 1;
    if (value < -error) return -1;
    return exact_side(point.planes, plane);
  }
  bool is_same(const ExactPoint& p, const ExactPoint& q) const;
  /// -1, 0, 1: p's coordinate is less, equal, greater. Points in the region.
  int compare(const ExactPoint& p, const ExactPoint& q, int axis) const;
  /// Of points in a plane and in the region, seen from the positive side of the axis that is
  /// square to both `u` and `v`, with v to the left of u: 1 if a, b, c turn to the left, -1 to the
  /// right, 0 not at all.
  int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int u, int v) const;

 private:
  PlaneSide exact_side(const std::array<uint32_t, 3>& point, uint32_t plane) const;

  const PlaneTable& planes_;
};

/// The axis along which a plane's normal is largest.
int largest_axis(const ExactPlane& plane);

/// The vector product of two normals: less than 2^107.
std::array<Int128, 3> direction(const ExactPlane& a, const ExactPlane& b);

}  // namespace whittle

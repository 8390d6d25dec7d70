// Planes with whole numbers for coefficients, so that every question about them has an exact
// answer.
//
// Bounds of sizes are counted in bits: coefficients of normals have 53, distances 80, so that
// determinants of four planes fit into 256.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "boundary/wide_int.h"
#include "lower/scene.h"

namespace whittle {

/// The points with n.y = d, where y are local coordinates times ExactGrid::per_unit(). Equal planes
/// have equal coefficients.
struct ExactPlane {
  std::array<int64_t, 3> n{};  ///< the largest is about 2^52; the first that is not 0 is positive
  Int128 d = 0;

  bool operator==(const ExactPlane&) const = default;
};

/// The same as doubles: divided by 2^52, so that n is no longer than about 1.
struct RoundedPlane {
  Vec3 n;        ///< exact
  double d = 0;  ///< rounded
};

/// A side of a plane: 1 where n.y > d, -1 where n.y < d.
using PlaneSide = int8_t;

/// From local coordinates to whole numbers.
class ExactGrid {
 public:
  /// `region` is finite and not empty.
  explicit ExactGrid(const Box& region);

  double per_unit() const { return per_unit_; }

  /// The plane of a half-space, rounded by 2^-52 in its normal and by some 10^-22 of the region in
  /// its distance (10^-17 if it is square to an axis). `inside`: the side on which the half-space
  /// is. Precondition: it is a plane, with a normal of about unit length.
  ExactPlane plane(const HalfSpace& h, PlaneSide& inside) const;
  /// The plane where a coordinate has that value.
  ExactPlane square_plane(int axis, double at) const;

 private:
  ExactPlane make(Vec3 n, long double d, PlaneSide& above) const;

  double per_unit_;
};

/// Gives planes numbers; equal ones get one.
class PlaneTable {
 public:
  uint32_t add(const ExactPlane& plane);
  /// A plane once more, by a number of its own, which add() and find() do not give.
  uint32_t add_copy(uint32_t number);
  /// The number of a plane that is there.
  uint32_t find(const ExactPlane& plane) const { return slots_[slot_of(plane)]; }

  const ExactPlane& operator[](uint32_t number) const { return planes_[number]; }
  const RoundedPlane& rounded(uint32_t number) const { return rounded_[number]; }
  size_t size() const { return planes_.size(); }

 private:
  static constexpr uint32_t kFree = UINT32_MAX;
  /// Where a plane is, or would be.
  size_t slot_of(const ExactPlane& plane) const;
  void grow();

  std::vector<ExactPlane> planes_;
  std::vector<RoundedPlane> rounded_;
  /// Numbers, by hash of the plane; less than half is taken. As many as a power of two.
  std::vector<uint32_t> slots_ = std::vector<uint32_t>(64, kFree);
  size_t taken_ = 0;
};

}  // namespace whittle

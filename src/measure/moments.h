// Integrals over a solid of 1, x, y, z and their products, and the area of its surface.
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace whittle {

/// Which integral. Products of coordinates i and j: product_of(i, j).
enum Moment : size_t {
  kVolume,
  kFirstX,
  kFirstY,
  kFirstZ,
  kXX,
  kYY,
  kZZ,
  kYZ,
  kXZ,
  kXY,
  kArea,
  kMomentCount
};
using Moments = std::array<double, kMomentCount>;

constexpr size_t first_of(int axis) {
  return size_t(kFirstX) + size_t(axis);
}
constexpr size_t product_of(int i, int j) {
  return i == j ? size_t(kXX) + size_t(i) : size_t(kYZ) + size_t(3 - i - j);
}

/// The same integrals where the coordinates' origin is at `center` of the new ones.
Moments moved(const Moments& moments, Vec3 center);

/// Of a box about the origin; no area.
Moments box_moments(Vec3 half);

/// Of a tetrahedron, whichever way it is turned; no area.
Moments tetrahedron_moments(const std::array<Vec3, 4>& corners);

/// How wrong the integrals can be at most if what is wrong has that volume and lies in a box.
Moments weighted(double volume, Vec3 center, Vec3 half);

/// A sum that is as if it had been made in twice the digits (Neumaier 1974).
class CompensatedSum {
 public:
  void add(double x);
  void add(const CompensatedSum& other);
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0, rest_ = 0;
};

/// Sums of integrals over parts, and of what each may be off.
class Integral {
 public:
  void add(const Moments& moments);
  void add(const Moments& moments, const Moments& bounds);
  void add(const Integral& other);
  void add_bounds(const Moments& bounds);

  double operator[](size_t moment) const { return sums_[moment].value(); }
  /// The truth is no farther from the value than this.
  double bound(size_t moment) const { return bounds_[moment]; }

 private:
  std::array<CompensatedSum, kMomentCount> sums_;
  Moments bounds_{};
};

}  // namespace whittle

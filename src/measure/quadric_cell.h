// Half-spaces as they are about the middle of a box, and planes in place of them.
#pragma once

#include <cstdint>
#include <span>

#include "lower/scene.h"
#include "measure/moments.h"

namespace whittle {

using Quadric = Kernels<double>::Quadric;

/// The half-space's f as a function of the way from `center`, a local point.
Quadric quadric_about(const HalfSpace& half_space, Vec3 center);

/// An entry of the second-degree part, a symmetric matrix.
inline double entry(const Quadric& f, int i, int j) {
  return i == j ? f.diag[i] : f.off[3 - i - j];
}

/// {q : n.q + d <= 0} in place of a half-space, in a box about the origin: in there f and the plane
/// differ by no more than `deviation`.
struct CellPlane {
  Vec3 n;
  double d = 0;
  double deviation = 0;
  double turn = 0;  ///< f's gradient differs from n by no more than this

  double at(Vec3 q) const { return dot(n, q) + d; }
};
CellPlane cell_plane(const Quadric& f, Vec3 half);

/// The volume, in the box, between the plane and one moved by the deviation. At most the box's.
double slab_volume(const CellPlane& plane, Vec3 half);

/// Along which axis a box that is not good enough is best cut, by what its halves are like.
int best_split(std::span<const Quadric> surfaces, Vec3 half);

/// Part of a solid in a box, its half-spaces planes. Row s of `table` is the solid where bit i of s
/// says "inside plane i"; it has all 64 rows, those of planes that are not there repeated.
struct PlaneCell {
  std::span<const CellPlane> planes;  ///< at most kTableLiterals
  uint64_t table = 0;
  Vec3 half;
};

/// Volume and the other integrals but the area, of the planes' solid.
Moments solid_moments(const PlaneCell& cell);

struct AreaBounds {
  double area = 0;   ///< of the planes' solid within the box
  double bound = 0;  ///< that of the half-spaces' is no farther from it
};
AreaBounds surface_area(const PlaneCell& cell);

/// No quadric has more surface in a box than this: every line meets it twice at most, so it is at
/// most twice its shadows along the axes.
double most_area(Vec3 half);

}  // namespace whittle

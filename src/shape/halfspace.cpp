#include "shape/halfspace.h"

namespace whittle {
namespace {

/// With unit normal. Divided by the largest component first, so that no square overflows or
/// vanishes.
Plane own_plane(const Halfspace& half) {
  const double m = max_component(abs(half.n));
  const double l = length(half.n / m);
  return {half.n / m / l, half.d / m / l};
}

Plane mapped(const Plane& plane, const Affine& map) {
  const Affine back = inverse(map);
  const Vec3 n = back.transposed_vector(plane.n);
  const double l = length(n);
  return {n / l, (plane.d - dot(plane.n, back.translation)) / l};
}

}  // namespace

bool Halfspace::is_empty() const {
  return !(is_finite(n) && std::isfinite(d)) || n == Vec3{};
}

std::vector<Plane> Halfspace::facet_planes() const {
  return {own_plane(*this)};
}

Box Halfspace::box(const Affine& map) const {
  const Plane plane = mapped(own_plane(*this), map);
  Box box = Box::everything();
  for (int axis = 0; axis < 3; ++axis) {
    if (plane.n[(axis + 1) % 3] != 0 || plane.n[(axis + 2) % 3] != 0) continue;
    if (plane.n[axis] > 0) box.hi[axis] = plane.d;
    if (plane.n[axis] < 0) box.lo[axis] = -plane.d;
  }
  return box;
}

Box Halfspace::finite_box(const Affine& map) const {
  const Plane plane = mapped(own_plane(*this), map);
  const Vec3 foot = plane.n * plane.d;
  return {foot, foot};
}

}  // namespace whittle

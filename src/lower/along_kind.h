// Which arithmetic a half-space gets along a ray, on every backend.
#pragma once

#include <cmath>

#include "kernels/constants.h"
#include "lower/scene.h"

namespace whittle {

/// `edge`: the longest of the scene's region.
inline AlongKind along_kind(const HalfSpace& h, double edge) {
  if (h.is_plane()) return AlongKind::kPlane;
  // As f is scaled, 2 |c| is the radius, or the least one.
  const bool is_small = 2 * std::fabs(h.f.c) < kSmallRadius * edge;
  if (h.kind == SurfaceKind::kSphere)
    return is_small ? AlongKind::kSmallSphere : AlongKind::kSphere;
  if (h.has_tip()) return is_small ? AlongKind::kSmallCone : AlongKind::kCone;
  if (is_small) return AlongKind::kSmallQuadric;
  const bool is_diagonal = h.f.off == Vec3{} && h.f.b == Vec3{};
  return is_diagonal ? AlongKind::kDiagonal : AlongKind::kQuadric;
}

}  // namespace whittle

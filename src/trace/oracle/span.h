// Where a ray is inside one convex primitive.
#pragma once

#include "base/box.h"
#include "trace/oracle/surfaces.h"

namespace whittle {

/// The part [t0, t1] of a ray inside a convex solid; either end may be infinite. Empty unless
/// t0 < t1: a ray that only touches has no part inside.
struct Span {
  double t0 = -kInfinity, t1 = kInfinity;
  Vec3 n0, n1;  ///< the solid's outward normals at both ends; of any length, unset at infinity

  bool is_empty() const { return !(t0 < t1); }
};

/// The part of the line origin + t * direction (world space, any t) inside a solid, with unit
/// normals in world space. Where faces lie on one surface the numbers t are equal to the bit.
Span ray_span(const Surfaces& surfaces, size_t solid, Vec3 origin, Vec3 direction);

/// Where the line origin + t * direction crosses a face that is flat, and its primitive's unit
/// outward normal there, world space. Not finite: it does not. The same number to the bit for all
/// faces on one surface, and as in ray_span.
struct PlaneCrossing {
  double t = kInfinity;
  Vec3 normal;
};
PlaneCrossing plane_crossing(const Surfaces& surfaces, const SurfaceFace& face, Vec3 origin,
                             Vec3 direction);

/// The part of a line inside a box.
Span ray_span(const Box& box, Vec3 origin, Vec3 direction);

}  // namespace whittle

// Where a ray is inside one convex primitive.
#pragma once

#include <vector>

#include "base/box.h"
#include "model/instances.h"

namespace whittle {

/// The part [t0, t1] of a ray inside a convex solid; either end may be infinite. Empty unless
/// t0 < t1: a ray that only touches has no part inside.
struct Span {
  double t0 = -kInfinity, t1 = kInfinity;
  Vec3 n0, n1;  ///< the solid's outward normals at both ends; of any length, unset at infinity

  bool is_empty() const { return !(t0 < t1); }
};

/// A primitive as the ray tests want it. The shape must outlive it.
struct ConvexSolid {
  const Shape* shape = nullptr;
  std::vector<Plane> planes;  ///< of flat shapes, in their own coordinates
  Vec3 anchor;                ///< a point near the shape's surface or middle, own coordinates
  Affine object_from_world;
};

/// Precondition: the instance is not empty.
ConvexSolid make_convex_solid(const Model& model, const Instance& instance);

/// The part of the line origin + t * direction (world space, any t) inside the solid, with unit
/// normals in world space.
Span ray_span(const ConvexSolid& solid, Vec3 origin, Vec3 direction);

/// The part of a line inside a box.
Span ray_span(const Box& box, Vec3 origin, Vec3 direction);

}  // namespace whittle

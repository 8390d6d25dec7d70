// The half-spaces whose conjunction is a primitive.
#pragma once

#include <vector>

#include "base/affine.h"
#include "lower/scene.h"
#include "model/model.h"

namespace whittle {

/// A primitive in local coordinates.
struct LoweredPrimitive {
  struct Surface {
    HalfSpace half_space;
    double extent;  ///< the primitive's surface lies within this distance of the centre
  };
  std::vector<Surface> surfaces;  ///< their conjunction is the primitive; empty: the empty set
  Vec3 inner_center;              ///< a ball that the primitive holds; radius 0 if not computed
  double inner_radius = 0;
};

/// Lowers one shape (not empty) under an invertible transform. The true sphere is one quadric,
/// the true cylinder or cone a quadric and two planes, everything flat its facets. If numbers
/// overflow there are no surfaces. `out` is reused.
void lower_primitive(const Shape& shape, const Affine& local_from_object, LoweredPrimitive& out);

}  // namespace whittle

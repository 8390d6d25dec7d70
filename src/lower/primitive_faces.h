// The half-spaces whose conjunction is a primitive.
#pragma once

#include <optional>
#include <vector>

#include "base/affine.h"
#include "lower/scene.h"
#include "shape/shape.h"

namespace whittle {

/// A primitive in local coordinates.
struct LoweredPrimitive {
  std::vector<HalfSpace> half_spaces;  ///< their conjunction is the primitive; empty: the empty set
  Extent extent;
  bool is_ball = false;  ///< the wall's, which is the first half-space; as the tip
  std::optional<Vec3> tip;
};

/// A facet of a mesh: its plane under an invertible transform, whose inverse is given too.
/// `middle`: a point in the midst of the mesh, mesh coordinates.
HalfSpace facet_half_space(const Plane& facet, Vec3 middle, const Affine& local_from_object,
                           const Affine& object_from_local);

/// Lowers one shape (not empty) under an invertible transform: its wall, if it has one, then its
/// planes. Of what is inside of a boundary, which may have millions, the extent alone. If numbers
/// overflow there are no half-spaces. `out` is reused.
void lower_primitive(const Shape& shape, const Affine& local_from_object, LoweredPrimitive& out);

/// How many faces it has: its wall, its planes, and the facets of a boundary.
size_t face_count(const Shape& shape);

/// The outline of its wall under the same transform.
std::vector<Vec3> wall_outline(const Shape& shape, const Affine& local_from_object);

}  // namespace whittle

// The curved face of a shape.
#pragma once

#include <cstddef>
#include <optional>

#include "base/vec.h"

namespace whittle {

/// A quadric about the z axis, in the shape's own coordinates: inside is where, with
/// q = p - center, squares.x q.x^2 + squares.y q.y^2 + squares.z q.z^2 + 2 along q.z + constant is
/// not positive.
struct Wall {
  Vec3 center;   ///< inside
  Vec3 squares;  ///< x and y are positive
  double along = 0;
  double constant = 0;           ///< negative
  std::optional<Vec3> tip = {};  ///< of a cone, where it is no farther from the center than the
                                 ///< shape is high
  /// It closes on itself, as a sphere does and a cylinder does not.
  bool is_ball() const { return squares.z > 0; }
};

/// The outline of a wall that is no ball is rings of so many points; a tip is none.
inline constexpr size_t kRingPoints = 8;

}  // namespace whittle

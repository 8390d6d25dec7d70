// The places where a ray crosses surfaces, and which of them count as one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "model/instances.h"

namespace whittle {

/// A ray's crossing of one primitive's surface.
struct Crossing {
  double t = 0;
  uint32_t leaf = 0;    ///< the primitive, as an index into instances()
  bool enters = false;  ///< the primitive, not the solid
  Vec3 normal;          ///< unit outward normal of the primitive, world space
};

/// What "the same surface" means in a model of these bounds (docs/conventions.md, Coincidence).
struct Coincidence {
  double distance = 0;  ///< across, model units
  /// Between the normals, as a sine. Two planes that are one surface within `distance` may part by
  /// no more than that over the model, that is, half its longest edge away from where they meet.
  double angle = 2 * kRelativeTolerance;

  explicit Coincidence(const Bounds& bounds);
  /// Precondition: the direction is unit.
  bool holds(const Crossing& a, const Crossing& b, Vec3 direction) const;
};

/// Sorts the crossings and gathers those that coincide: afterwards they stand group by group, in
/// the order of the groups' first members. `group_ends` receives the end of each group. Every
/// member coincides with its group's first; groups do not chain.
void group_crossings(std::vector<Crossing>& crossings, Vec3 direction,
                     const Coincidence& coincidence, std::vector<size_t>& group_ends);

}  // namespace whittle

// Surfaces in a small cell, as their tangent planes and how far they bend away from these.
#pragma once

#include <optional>
#include <span>

#include "lower/scene.h"
#include "subdivide/linear_program.h"

namespace whittle {

/// All that a literal holds around a point, q relative to it: n.q + q.Bq <= d, n unit, B given by
/// its diagonal and (B_yz, B_xz, B_xy).
struct Tangent {
  Constraint plane;
  Vec3 diag, off;
};

/// The tangent of a literal's surface around a local point. None where the surface has no
/// direction.
std::optional<Tangent> tangent(const Scene& scene, Literal literal, Vec3 center);

/// A constraint on all points of the literal in the cell of that half size: the tangent plane,
/// moved out by as much as the surface may bend away from it.
Constraint outer_plane(const Tangent& tangent, Vec3 half);

/// An upper bound of objective.q over the points of the cell that fulfil all of up to three
/// tangents; infinity if there is none. It comes from the sum of the tangents whose normals combine
/// to the objective as nearly as possible. Bends of opposite sign cancel in that sum, so the rim
/// where two surfaces meet is bounded as exactly as a corner of planes.
double combined_reach(std::span<const Tangent* const> tangents, Vec3 objective, Vec3 half);

}  // namespace whittle

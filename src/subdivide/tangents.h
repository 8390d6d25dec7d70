// Surfaces in a small cell, as their tangent planes and what they bend away from them.
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

/// No point of the cell that fulfils all of up to three tangents has a larger objective.q than
/// this. It is the sum of the tangents in which the objective is nearest to the normals: what they
/// bend in opposite ways cancels, so the rim of two surfaces that meet is found as exactly as a
/// corner of planes. Infinity if they say nothing.
double combined_reach(std::span<const Tangent* const> tangents, Vec3 objective, Vec3 half);

}  // namespace whittle

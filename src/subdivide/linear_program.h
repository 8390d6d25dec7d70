// The farthest point of a small polytope: a linear program in three variables.
//
// Based on: Seidel, "Small-dimensional linear programming and convex hulls made easy" (1991), with
// the constraints in the order given: they are few, and the result must not depend on chance.
#pragma once

#include <optional>
#include <span>

#include "base/vec.h"

namespace whittle {

/// The points with n.p <= d; n is unit.
struct Constraint {
  Vec3 n;
  double d = 0;
};

/// A point with the largest `objective`.p among those with |p| <= half in each coordinate that
/// fulfil all constraints; none if there is no such point. Right to about 1e-12 of the longest
/// half: what is infeasible by less may be found feasible, and the other way round. Time grows with
/// the cube of the number of constraints at worst. Precondition: half is positive.
std::optional<Vec3> farthest_point(Vec3 objective, std::span<const Constraint> constraints,
                                   Vec3 half);

}  // namespace whittle

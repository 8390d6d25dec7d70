// From points and faces to the planes of a convex solid.
#pragma once

#include <optional>
#include <string>

#include "model/model.h"

namespace whittle {

/// Fills `planes` from `points` and `faces`. Returns nothing if that went well, else the reason why
/// this is no closed convex solid ("it is not convex: ..."), and then `planes` is empty.
///
/// Faces with fewer than 3 corners are left out. Faces run clockwise seen from outside; if all of
/// them run the other way round, the solid is turned outward. Points at the same place are one
/// point. Texts carry six digits, so corners may stray from their face's plane, and the solid from
/// being convex, by kPolyhedronSlack of the solid's diagonal. Faces that lie in one plane, to
/// kSamePlane of it, give one plane. A solid without faces, without volume (thinner than
/// kFlatSolid), or with a corner that is not finite, has no planes and is no mistake.
///
/// Cost: about n log n in the number of corners, where most corners are corners of the solid.
std::optional<std::string> build_planes(Polyhedron& polyhedron);

inline constexpr double kPolyhedronSlack = 1e-5;
inline constexpr double kSamePlane = 2e-6;
inline constexpr double kFlatSolid = 1e-6;

}  // namespace whittle

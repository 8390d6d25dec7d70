// From points and faces to the planes of a convex solid.
#pragma once

#include <string>

#include "shape/polyhedron.h"

namespace whittle {

/// What is to be said of a polyhedron, in words.
struct Verdict {
  std::string refusal = {};  ///< why it is no closed convex solid: "it is not convex: ..."
  std::string remark = {};   ///< how it was read, where it might have been meant otherwise
};

/// Fills `planes` and `rise` from `points` and `faces`. After a refusal there are no planes.
///
/// Faces with fewer than 3 corners are left out. Faces run clockwise seen from outside; if all of
/// them run the other way round, the solid is turned outward. Points at the same place are one
/// point. Texts carry six digits: a corner may be half a unit of the sixth digit of the largest
/// x, y and z away from where it was meant to be, and in any case kLeastStray of the solid's
/// diagonal. Faces may be as far from flat, and the solid from convex, as corners that are so far
/// off can make them. A face that is less flat (by kFlatFace of that) is replaced in `faces` by
/// triangles, so that the solid becomes convex, with a remark. Faces that lie in one plane, to
/// kSamePlane of the diagonal and kSameOfThin of the thickness, give one plane. A solid without
/// faces, without volume (thinner than kFlatSolid), or with a corner that is not finite, has no
/// planes and is no mistake.
///
/// Cost: about n log n in the number of corners, where most corners are corners of the solid.
Verdict build_planes(Polyhedron& polyhedron);

inline constexpr double kLeastStray = 5e-6;
inline constexpr double kFlatFace = 4;
inline constexpr double kSamePlane = 2e-6;
inline constexpr double kSameOfThin = 1e-3;
inline constexpr double kFlatSolid = 1e-6;

}  // namespace whittle

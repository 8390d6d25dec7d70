// The edges of a solid that a drawing shows.
#pragma once

#include <cstdint>
#include <vector>

#include "base/workers.h"
#include "boundary/solid_mesh.h"
#include "lines/projection.h"
#include "lines/true_normals.h"

namespace whittle {

/// Why a part of an edge may be none that one wants to see; what is beside it decides.
enum class Doubt {
  kNone,
  kMade,  ///< its facets are of the drawing's own making, the true surfaces may be smooth there
  kFold,  ///< a contour on a surface of many flat parts that is seen along, and so may be wrinkled
};

/// An edge at which one or both of a drawing's reasons to show it hold.
struct SolidEdge {
  Vec3 from, to;
  bool is_contour = false;  ///< one face looks to the eye, one away
  /// What is behind it is covered on one side and not on the other. Where the solid is hollow, not.
  bool may_cover = false;
  bool may_be_seen = false;  ///< unless something is before it
  Doubt doubt = Doubt::kNone;
  /// In doubt, how far it may be from where it belongs; in units of the drawing's fineness.
  double stray = 0;
  double fold = 0;  ///< of a possible fold, how long the folded part can be at most
  Vec3 inward;      ///< unit; from the edge into a face that looks to the eye, if there is one
};

/// Contours, and creases: where two surfaces meet at an angle. Those of one body made of many flat
/// or curved parts are creases from kCreaseOfBody degrees on, others from kCrease. A surface with
/// many facets counts as the curve it stands for. `is_inside`: the eye is in the solid, and sees
/// what looks away from it.
std::vector<SolidEdge> solid_edges(const SolidMesh& mesh, const TrueNormals& normals,
                                   const ViewProjection& projection, bool is_inside,
                                   const Workers& workers);

inline constexpr double kCrease = 5, kCreaseOfBody = 25;

}  // namespace whittle

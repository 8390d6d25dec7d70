// Where curved surfaces stand in a space in which equal ones are neighbours.
#pragma once

#include "lower/point_index.h"
#include "lower/scene.h"

namespace whittle {

/// What of a primitive decides which surfaces its own are one with. Local coordinates.
struct Reach {
  Vec3 center;  ///< the primitive lies in this ball
  double radius = 0;
  double width = 0;       ///< see Extent
  double tolerance = 0;   ///< see own_tolerance()
  double ball_reach = 0;  ///< of the outline of a sphere's image from its middle; 0 for the rest

  bool operator==(const Reach&) const = default;
};

/// Where a curved surface stands; `region`: half the region's size. A ball's place is its middle's
/// but for the asinh of each coordinate, which makes nothing larger.
PointIndex::Point fingerprint_point(const HalfSpace& h, bool is_ball, double region);

/// How far from a surface of the primitive with this reach an equal one can be, in each coordinate;
/// in proportion to the tolerance.
double fingerprint_slack(const Reach& reach, double region);

/// Both of one surface.
struct Fingerprint {
  PointIndex::Point point{};
  double slack = 0;
};
inline Fingerprint fingerprint(const HalfSpace& h, bool is_ball, const Reach& reach,
                               double region) {
  return {fingerprint_point(h, is_ball, region), fingerprint_slack(reach, region)};
}

}  // namespace whittle

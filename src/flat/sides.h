// What the edges of a polygon sweep when it is extruded.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/triangulation.h"

namespace whittle {

/// More side faces than this are never made: slices and steps are coarser instead.
inline constexpr double kMaxSides = 5e5;

struct ContourSide {
  uint32_t from = 0, to = 0;  ///< the edge
  /// The line it lies on. Edges of a contour that follow one another without a bend have it in
  /// common.
  Vec2 line_from, line_to;
  bool is_hole = false;  ///< the contour runs clockwise
};

/// Of all contours.
std::vector<ContourSide> sides(const WeldedPolygons& polygons);

}  // namespace whittle

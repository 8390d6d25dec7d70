// Triangles that fill polygons, by number of corner.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flat/polygons.h"

namespace whittle {

/// Polygons whose equal corners are one point.
struct WeldedPolygons {
  std::vector<Vec2> points;  ///< by x, then by y; no two are equal
  /// Numbers of points. Successive ones differ, and none of less than two is here.
  std::vector<std::vector<uint32_t>> contours;
};

/// Corners that are not finite are left out.
WeldedPolygons weld(const Polygons& polygons);

/// Corners are numbers of points; no two of one triangle are equal. For any contours at all, also
/// such that cross: as many triangles run along an edge one way as contours do, once what runs the
/// other way is taken off. Time n log n.
///
/// If the contours are polygons as promised, triangles run counter-clockwise and do not overlap;
/// where a corner lies within an edge, one of them has no area.
///
/// A plane sweep into x-monotone pieces (Garey, Johnson, Preparata, Tarjan: Triangulating a simple
/// polygon, Information Processing Letters 7, 1978).
std::vector<std::array<uint32_t, 3>> triangulate(const WeldedPolygons& polygons);

}  // namespace whittle

// Contours as linked corners that a sweep can cut into pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flat/numbered_points.h"
#include "flat/triangulation.h"

namespace whittle {

/// Corners in closed rings; the region lies to the left.
///
/// Where contours touch in a point their corners are joined anew, so that each has a sector of the
/// region for itself and nothing else reaches into that.
class CornerRings {
 public:
  struct Corner {
    uint32_t point = 0, previous = 0, next = 0;
    uint32_t origin = 0;  ///< the corner that it is a part of since cuts were made
  };
  struct Edge {
    uint32_t from = 0, to = 0;  ///< points

    auto operator<=>(const Edge&) const = default;
  };

  /// As many edges must come to a point as leave it. The corner that an edge leaves has its number.
  CornerRings(const std::vector<Edge>& edges, const NumberedPoints& points);
  /// Edges that run along one another in opposite directions are no edges.
  CornerRings(const WeldedPolygons& polygons, const NumberedPoints& points);

  uint32_t size() const { return uint32_t(corners_.size()); }
  const Corner& operator[](uint32_t corner) const { return corners_[corner]; }
  uint32_t previous_point(uint32_t corner) const { return point(corners_[corner].previous); }
  uint32_t point(uint32_t corner) const { return corners_[corner].point; }
  uint32_t next_point(uint32_t corner) const { return point(corners_[corner].next); }

  /// A cut from corner a to corner b. It splits a ring in two, or makes one of two. Afterwards a
  /// has the cut as its way out and b as its way in; the rest of a is the corner returned, and the
  /// rest of b the one after that.
  uint32_t cut(uint32_t a, uint32_t b);

 private:
  std::vector<Corner> corners_;
};

/// Triangles that fill the rings, of origins of corners (see triangulation.h). The rings are cut to
/// pieces.
std::vector<std::array<uint32_t, 3>> triangulate(CornerRings& rings, const NumberedPoints& points);

/// Fills every ring, taking it for x-monotone. Triangles of origins of corners, no two of which are
/// one point.
std::vector<std::array<uint32_t, 3>> fill_monotone(const CornerRings& rings,
                                                   const NumberedPoints& points);

}  // namespace whittle

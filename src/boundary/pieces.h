// The boundary of a solid in pieces, as cells cut it.
#pragma once

#include <cstdint>
#include <vector>

#include "boundary/exact_point.h"

namespace whittle {

/// One side of a plane: the plane's number * 2, plus 1 if it is seen from below (n.y < d).
using Sheet = uint32_t;

constexpr Sheet sheet_of(uint32_t plane, bool from_below) {
  return plane * 2 + uint32_t(from_below);
}

/// Convex polygons that together are the boundary. Each runs counter-clockwise seen from its
/// sheet's side, which is outside.
struct Pieces {
  struct Corner {
    uint32_t point;       ///< into points
    uint32_t edge_plane;  ///< the edge to the next corner lies in it
  };
  struct Piece {
    Sheet sheet;
    uint32_t owner;         ///< id of the body
    uint32_t first, count;  ///< into corners
  };
  std::vector<ExactPoint> points;
  std::vector<Corner> corners;
  std::vector<Piece> pieces;
};

}  // namespace whittle

// The boundary of a solid in pieces, as cells cut it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boundary/exact_point.h"

namespace whittle {

/// One side of a plane: the plane's number * 2, plus 1 if it is seen from below (n.y < d).
using Sheet = uint32_t;

constexpr Sheet sheet_of(uint32_t plane, bool from_below) {
  return plane * 2 + uint32_t(from_below);
}

/// Convex polygons that together are the boundary, by their edges. Edges that two polygons of one
/// plane and cell share may be left out.
struct Pieces {
  /// Runs counter-clockwise around its polygon, seen from the sheet's side, which is outside.
  struct Edge {
    Sheet sheet;
    uint32_t plane;     ///< the other plane that it lies in
    uint32_t from, to;  ///< into points
  };
  struct Owner {
    Sheet sheet;
    uint32_t id;  ///< of a body that has a part of the sheet

    auto operator<=>(const Owner&) const = default;
  };
  std::vector<ExactPoint> points;
  std::vector<Edge> edges;
  std::vector<Owner> owners;
  size_t count = 0;  ///< of polygons
};

}  // namespace whittle

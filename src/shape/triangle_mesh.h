// A closed surface of triangles: what polyhedra, extrusions and imported files come to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/plane.h"

namespace whittle {

/// The solid is where the winding number of the triangles is not zero, regularised. Triangles may
/// overlap and cut one another, but every edge is closed: it is run through as often one way as the
/// other.
struct TriangleMesh {
  struct Triangle {
    std::array<uint32_t, 3> corners{};  ///< into points; counter-clockwise seen from outside
    uint32_t facet = 0;                 ///< into facets: the plane it lies in
  };
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  /// Outward. Triangles that lie in one plane, as far as the digits of their corners tell, name the
  /// same one.
  std::vector<Plane> facets;
  double rise = 0;  ///< corners are no farther than this from the planes of their triangles
};

/// Negative if the triangles are turned inward.
double volume(const TriangleMesh& mesh);

}  // namespace whittle

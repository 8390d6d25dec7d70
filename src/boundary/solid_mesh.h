// A solid's boundary as triangles: the same faces, with corners as numbers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "model/model.h"

namespace whittle {

/// Closed, oriented and manifold by number of corner: every edge of a triangle is there exactly
/// once each way, and the triangles at a corner are one fan. Where a solid touches itself, corners
/// are there more than once, at one place.
struct SolidMesh {
  struct Triangle {
    std::array<uint32_t, 3> corners;  ///< counter-clockwise seen from outside
    uint32_t face;                    ///< into faces
  };
  /// A plane's side, as far as it is boundary, in one part or several; of those of one paint, if
  /// there were paints (evaluate_solid.h).
  struct Face {
    Vec3 outward;             ///< unit normal
    uint32_t owner = 0;       ///< id of the first body in the file that has a part of it
    uint32_t half_space = 0;  ///< of the scene, the first that its plane bounds
    Rgba color{};             ///< the outermost valid color() above that; invalid if none
  };
  std::vector<Vec3> corners;  ///< world coordinates
  std::vector<Triangle> triangles;
  std::vector<Face> faces;
};

}  // namespace whittle

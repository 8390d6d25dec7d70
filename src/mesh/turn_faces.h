// Faces that are turned to agree with their neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "mesh/edges.h"

namespace whittle {

/// The parts of a mesh: triangles that are connected by edges.
struct MeshParts {
  std::vector<uint32_t> part_of;  ///< one a triangle
  std::vector<uint8_t> is_open;   ///< one a part: an edge of it is not closed
  size_t open_edges = 0;          ///< of all parts
  Vec3 first_open;                ///< the middle of the first open edge
  size_t turned = 0;              ///< triangles that were turned
};

/// Turns triangles so that every edge is used as often in one direction as in the other, where
/// possible. At an edge with two triangles they use it in opposite directions. At an edge with
/// more, triangles that are also connected elsewhere are paired; the rest keep their directions if
/// these balance, and else alternate around the edge. A connected part keeps the orientation of
/// most of its area. Every part closes by itself, or is open.
MeshParts turn_faces(std::span<const Vec3> points, std::vector<Corners>& triangles);

}  // namespace whittle

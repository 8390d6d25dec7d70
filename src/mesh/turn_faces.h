// Faces that are turned to agree with their neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "mesh/edges.h"

namespace whittle {

/// Triangles that hang together by edges.
struct MeshParts {
  std::vector<uint32_t> part_of;  ///< one a triangle
  std::vector<uint8_t> is_open;   ///< one a part: an edge of it is not closed
  size_t open_edges = 0;          ///< of all parts
  Vec3 first_open;                ///< the middle of the first open edge
  size_t turned = 0;              ///< triangles that were turned
};

/// Turns triangles so that every edge is run through as often one way as the other, where that can
/// be. At an edge with two triangles they run opposite ways. At one with more those that hang
/// together otherwise make up for one another; the rest do as they did from the start if that fits,
/// else in turn around the edge. What hangs together keeps the way that most of its area was
/// turned. Every part closes by itself, or is open.
MeshParts turn_faces(std::span<const Vec3> points, std::vector<Corners>& triangles);

}  // namespace whittle

// Faces as loops of corners, and what lies across an edge.
#pragma once

#include <cstdint>
#include <vector>

#include "boundary/solid_mesh.h"

namespace whittle {

/// Of half-edges, which are numbered 3 t + i from corner i of triangle t to the next: the same edge
/// as the other triangle runs along it.
std::vector<uint32_t> twins_of(const SolidMesh& mesh);

/// Half-edge 3 t + 1 follows 3 t, and so on around.
inline uint32_t next_half_edge(uint32_t edge) {
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}

/// By face: its outlines as corners. What is solid lies to their left, seen from outside. Where
/// faces meet in the middle of an edge, the corner there is in both.
std::vector<std::vector<std::vector<uint32_t>>> face_loops(const SolidMesh& mesh);

}  // namespace whittle

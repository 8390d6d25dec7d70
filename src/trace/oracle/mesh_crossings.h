// Where a ray enters and leaves a mesh, by looking at every triangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trace/oracle/surfaces.h"

namespace whittle {

/// A mesh in world space, its triangles counter-clockwise seen from outside.
struct WorldMesh {
  struct Triangle {
    std::array<uint32_t, 3> corners{};
    uint32_t face = 0;  ///< of the solid (Surfaces::faces_of)
  };
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

WorldMesh world_mesh(const TriangleMesh& mesh, const Affine& world_from_mesh);

struct MeshCrossing {
  double t = 0;
  bool enters = false;
  Vec3 normal;  ///< unit, outward, world space
};

/// The crossings of the line origin + t * direction (any t) with a mesh that is one of the solids,
/// by t. Each is at the named surface of its triangle. In and out alternate: where the winding
/// number goes from zero to another and back.
void mesh_crossings(const Surfaces& surfaces, size_t solid, const WorldMesh& mesh, Vec3 origin,
                    Vec3 direction, std::vector<MeshCrossing>& out);

}  // namespace whittle

// From triangles as a file has them to a closed surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "model/triangle_mesh.h"

namespace whittle {

/// As read: points may be given many times over, faces may be turned any way.
struct RawMesh {
  std::vector<Vec3> points;
  /// Corner loops; counter-clockwise seen from outside where the format says so. Most are
  /// triangles; others need be neither flat nor convex.
  std::vector<std::vector<uint32_t>> faces;
  /// Triangles, in place of `faces` where there are millions.
  std::vector<std::array<uint32_t, 3>> triangles;
};

struct ClosedMesh {
  TriangleMesh mesh;        ///< without triangles: nothing closed was left
  size_t open_edges = 0;    ///< edges of what was left out, because it is not closed
  Vec3 first_open;          ///< the middle of the first of them
  size_t turned_faces = 0;  ///< faces that were turned to agree with their neighbours
};

/// Welds points that differ by less than `digits` of the extents can tell (half a unit of the sixth
/// digit; 0 for bodies made of numbers), cuts faces into triangles, turns faces consistently edge
/// by edge within each connected part, leaves out parts that stay open, and finds which triangles
/// lie in one plane. Linear but for sorting.
ClosedMesh close_mesh(const RawMesh& raw, double digits);

}  // namespace whittle

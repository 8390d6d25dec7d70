// From the triangles of a file to a closed surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "shape/triangle_mesh.h"

namespace whittle {

/// A mesh as a file gives it: points may be repeated, and faces may be turned either way.
struct RawMesh {
  std::vector<Vec3> points;
  /// Corner loops; counter-clockwise seen from outside where the format says so. Most are
  /// triangles; others need be neither flat nor convex.
  std::vector<std::vector<uint32_t>> faces;
  /// Triangles, in place of `faces` where there are millions.
  std::vector<std::array<uint32_t, 3>> triangles;
  /// Made so that no point is given twice, none is farther away than kFarthest, every edge is
  /// closed, and all faces face outward.
  bool is_closed = false;
};

/// Products of three coordinates beyond this are no numbers any more.
inline constexpr double kFarthest = 1e75;

struct ClosedMesh {
  TriangleMesh mesh;        ///< without triangles: nothing closed was left
  size_t open_edges = 0;    ///< edges of what was left out, because it is not closed
  Vec3 first_open;          ///< the middle of the first of them
  size_t turned_faces = 0;  ///< faces that were turned to agree with their neighbours
};

/// Closes a surface, with coordinates of so many significant decimal digits (0: as many as a double
/// has). Points closer than half a unit of the last digit of the largest coordinate are one. Faces
/// are cut into triangles and, within each part that hangs together by edges, turned so that
/// neighbours agree, most of them as they were. Parts that have an open edge are left out. If the
/// volume of all is negative all is turned; a part of negative volume that no other is around is
/// turned, too. Faces with a corner that is not finite, or farther away than kFarthest, are not
/// there. About n log n.
ClosedMesh close_mesh(const RawMesh& raw, int digits);

}  // namespace whittle

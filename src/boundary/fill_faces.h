// From outlines to triangles. All is decided by exact corners; they are rounded at the end.
#pragma once

#include <cstdint>
#include <vector>

#include "base/workers.h"
#include "boundary/faces.h"

namespace whittle {

/// Triangles that fill the outlines of faces.
struct FilledFaces {
  struct Triangle {
    /// Corners of outlines, each named by the half-edge that leaves it.
    std::array<uint32_t, 3> corners;
    Sheet sheet;
  };
  std::vector<Triangle> triangles;  ///< by sheet
  std::vector<uint32_t> next;       ///< by half-edge: the next one of its outline
  /// By half-edge: the fan of triangles that its corner belongs to.
  std::vector<uint32_t> fans;
  /// By fan: into FaceOutlines::points. A point has one or several fans.
  std::vector<uint32_t> points;
};

FilledFaces fill(const FaceOutlines& outlines, const ExactGeometry& geometry,
                 const Workers& workers);

}  // namespace whittle

// Pieces joined: the outlines of faces, whose edges lie where two planes meet, and their
// neighbours across each edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/workers.h"
#include "boundary/pieces.h"

namespace whittle {

/// An edge as one face runs along it; the face lies to its left, seen from outside.
struct HalfEdge {
  Sheet sheet;
  uint32_t from, to;  ///< into FaceOutlines::points
  uint32_t twin;      ///< the same edge as its other face runs along it
};

/// The boundary as closed outlines. Every edge is there exactly twice, once each way.
struct FaceOutlines {
  std::vector<ExactPoint> points;  ///< no two are equal
  /// By sheet; those of one sheet stand in a row.
  std::vector<HalfEdge> edges;
  /// Edges in which more than two faces meet.
  size_t shared_edges = 0;
};

/// What is on one line goes away where faces of one sheet meet on it; what is left is cut at all
/// corners on it. Where more than two faces meet in an edge, those that bound the same piece of
/// material are twins, so that solids which only touch are apart (docs/decisions/0040-boundary.md).
///
/// An error if the pieces do not bound a solid; `open_planes` then are planes of lines on which
/// they are open, in order.
Result<FaceOutlines> join(const Pieces& pieces, const ExactGeometry& geometry,
                          const Workers& workers, std::vector<uint32_t>& open_planes);

}  // namespace whittle

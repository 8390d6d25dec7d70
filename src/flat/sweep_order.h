// The order of edges along a line that sweeps the plane from left to right.
#pragma once

#include <cstdint>

#include "flat/numbered_points.h"

namespace whittle {

/// Numbers of points, which are numbered by x, then by y; from < to, so it runs to the right.
struct SweptEdge {
  uint32_t from = 0, to = 0;
};

/// Whether e runs below f where the line crosses both. Both must be crossed at some time at once.
/// Edges of which one ends where the other begins: the former counts as below. 0: they lie on one
/// another.
inline int below(const NumberedPoints& points, const SweptEdge& e, const SweptEdge& f) {
  if (e.to == f.from) return 1;
  if (f.to == e.from) return -1;
  const bool f_first = e.from > f.from;
  const SweptEdge &first = f_first ? f : e, &second = f_first ? e : f;
  const auto side = [&](uint32_t point) { return points.turn(first.from, first.to, point); };
  double turn = side(second.from);
  if (turn == 0) turn = side(second.to);
  if (turn == 0) return 0;
  return (turn > 0) == f_first ? -1 : 1;
}

/// How far, in sign, a point that the line passes lies above an edge that it crosses then. Edges
/// that begin or end there are not below it.
inline double above(const NumberedPoints& points, const SweptEdge& edge, uint32_t point) {
  if (edge.from == point || edge.to == point) return -1;
  return points.turn(edge.from, edge.to, point);
}

}  // namespace whittle

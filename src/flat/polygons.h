// Flat shapes as polygons, and what can be done with them: OpenSCAD's two-dimensional subsystem.
//
// Booleans, offsets and sums are Clipper's, on a grid of integers whose step is at most 2^-33 of
// the largest coordinate (OpenSCAD's keeps about 8 decimal digits). Corners that an operation
// leaves alone come back as they were written, to the last digit, so that faces which were written
// to be flush stay so. Corners that are not finite are left out.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// The last corner is joined to the first.
using Contour = std::vector<Vec2>;

/// A regularised region of the plane: outer contours run counter-clockwise, holes clockwise; they
/// do not cross themselves or one another, though corners may touch. Operations hold to that to the
/// last digit, and give only that; they take any contours, even-odd, and so also such as a mirror
/// has turned round.
struct Polygons {
  std::vector<Contour> contours;

  bool is_empty() const { return contours.empty(); }
};

struct Rect {
  Vec2 lo, hi;
};

/// Of polygons that are not empty.
Rect bounds(const Polygons& polygons);

/// The region that contours of any kind enclose an odd number of times.
Polygons even_odd(std::span<const Contour> contours);

/// The region about which contours of any kind wind, whichever way and how often: where it is as
/// often one way as the other is outside.
Polygons nonzero(std::span<const Contour> contours);

Polygons unite(std::span<const Polygons> operands);
Polygons intersect(std::span<const Polygons> operands);
/// The first without all others.
Polygons subtract(std::span<const Polygons> operands);

/// How corners look that an offset moves away from.
enum class Join { kRound, kMiter, kSquare };

/// `delta` outwards, or inwards if it is negative. `fragments`: of a full circle of that radius,
/// for kRound; more than kMaxFacets are as many. Empty if delta is not finite. Miters go out to a
/// million times delta, as OpenSCAD's do.
Polygons offset(const Polygons& polygons, double delta, Join join, int fragments);

/// Without holes.
Polygons filled(const Polygons& polygons);

/// The convex hull of all of them.
Polygons convex_hull(std::span<const Polygons> operands);

/// The Minkowski sum of all of them, one after the other; empty if one is. Time grows with the
/// product of the numbers of corners of two shapes, with less if one of them is convex.
Polygons minkowski_sum(std::span<const Polygons> operands);

/// OpenSCAD's polygon for a circle: n >= 3 corners, the first on +x.
Contour circle(double r, int n);

/// Each triangle three points, counter-clockwise, that are corners of the polygons. Every edge of
/// a contour is an edge of exactly one triangle. Of contours that cross, see triangulation.h.
std::vector<std::array<Vec2, 3>> triangulate(const Polygons& polygons);

}  // namespace whittle

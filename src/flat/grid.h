// Between polygons and Clipper's grid of integers.
#pragma once

#include <clipper.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "flat/polygons.h"

namespace whittle {

/// The grid of one operation: a power of two that takes the farthest of all its coordinates to
/// between 2^33 and 2^34. So a step is at most 2^-33 of that coordinate.
///
/// It remembers every corner that it has taken to the grid. A corner that comes back from the same
/// place is the one that went there, to the last digit, so what an operation leaves alone stays
/// as it was written.
class Grid {
 public:
  /// For coordinates up to `reach` in absolute value.
  explicit Grid(double reach);

  /// Points that are not finite, or out of reach, are left out.
  ClipperLib::Path to_grid(const Contour& contour);
  ClipperLib::Paths to_grid(const Polygons& polygons);

  /// A length in steps.
  double steps(double length) const;

  /// Free of crossings for certain.
  Polygons from_grid(ClipperLib::Paths rough) const;
  /// As from_grid, but without the corners as they were written.
  Vec2 place(const ClipperLib::IntPoint& point) const;

 private:
  struct Hash {
    size_t operator()(const ClipperLib::IntPoint& p) const;
  };

  int exponent_;
  std::unordered_map<ClipperLib::IntPoint, Vec2, Hash> written_;
};

/// The largest finite coordinate in absolute value; 0 if there is none.
double reach(std::span<const Contour> contours);
double reach(std::span<const Polygons> operands);

/// What `paths` enclose by `rule`. Nothing if Clipper gives up.
ClipperLib::Paths clip(ClipperLib::ClipType operation, const ClipperLib::Paths& subject,
                       const ClipperLib::Paths& clips, ClipperLib::PolyFillType rule);

/// The union of what `paths` enclose an odd number of times.
ClipperLib::Paths sanitized(const ClipperLib::Paths& paths);

}  // namespace whittle

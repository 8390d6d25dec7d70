// How much of every pixel a section covers.
#pragma once

#include <functional>
#include <span>

#include "flat/polygons.h"

namespace whittle {

/// Square pixels over the plane, y pointing up in the plane and rows going down.
struct PixelFrame {
  int width = 0, height = 0;
  Vec2 corner;       ///< the upper left one of the upper left pixel
  double pixel = 1;  ///< a pixel's side, above 0
};

/// The frame whose middle is that of the box, with pixels of that size; or, if it is 0, with the
/// smallest that hold all of the box.
PixelFrame frame_around(const Rect& box, int width, int height, double pixel);

/// Takes the shares of a row's pixels that are covered, 0 to 1.
using CoverageRow = std::function<void(int row, std::span<const double> shares)>;

/// The exact areas, to rounding, that loops cover of pixels, outer ones counter-clockwise and holes
/// clockwise. Rows come from the top; those that no loop is in are left out. What lies outside of
/// the frame does not count.
void cover_pixels(std::span<const Contour> loops, const PixelFrame& frame, const CoverageRow& take);

}  // namespace whittle

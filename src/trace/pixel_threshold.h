// The paper's pixel threshold: is a cell too small in the picture to be split any further?
//
// Based on: Romeiro, Velho, de Figueiredo 2008, section 2.2. The area that a cell projects to is
// judged by the projected lengths of its edges, of which only the parts on the visible screen
// count. What we changed: a cell that covers the whole screen shows no edge at all and yet is not
// small.
#pragma once

#include "base/box.h"
#include "trace/camera.h"

namespace whittle {

/// The threshold of one camera. It has no state that changes, so it is thread-safe.
class PixelThreshold {
 public:
  PixelThreshold(const Camera& camera, double pixels);

  /// True if every edge of the box (world coordinates) has a visible part shorter than `pixels`, so
  /// also if the box is out of sight. Precondition: the box is finite.
  bool operator()(const Box& box) const;

 private:
  /// Corners in camera coordinates (x right, y up, z forward).
  struct Corners {
    double x[8], y[8], z[8];
  };
  Corners corners_of(const Box& box) const;
  bool shows_all_of(const Corners& corners) const;
  bool edges_are_short(const Corners& corners) const;
  double inside(int side, Vec3 p) const;
  double distance_in_pixels(Vec3 a, Vec3 b) const;
  double visible_length(Vec3 a, Vec3 b) const;
  bool covers_screen(const Box& box) const;

  Camera camera_;
  double pixels_;
  // The visible space at z = 1, or everywhere if orthographic; and the way to pixels.
  double half_width_, half_height_, pixels_per_unit_;
  bool is_coarse_;  ///< a box with short edges may cover the screen
};

}  // namespace whittle

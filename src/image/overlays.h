// What can be drawn over a picture to say where and how large things are.
#pragma once

#include <string>

#include "base/box.h"
#include "image/picture.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

struct OverlaySettings {
  bool axes = false;       ///< x red, y green, z blue, through the origin; paler where negative
  bool grid = false;       ///< in the plane z = 0, round lengths apart
  bool scale_bar = false;  ///< of an orthographic camera
  std::string title{};

  bool any() const { return axes || grid || scale_bar || !title.empty(); }
};

/// Draws them. Lines in the world are hidden where the solid is in front of them, and end a little
/// beyond `solid`, the box of what is looked at. A scale bar is a round length, up to a quarter of
/// the picture's width. Preconditions: frame and picture have the camera's size, and for a scale
/// bar it is orthographic. An empty or infinite box counts as one around the origin.
void draw_overlays(const OverlaySettings& overlays, const Camera& camera, const Frame& frame,
                   const Box& solid, Picture& picture);

/// 1, 2 or 5 times a power of ten: the largest that is no more than `most`, which is positive.
double round_length(double most);

/// The lines of the grid in one direction: from `first` on in steps of `step`, so many.
struct GridLines {
  double first = 0, step = 1;
  int count = 0;
};
/// Those that hold an interval between them; the step is a round length, so that the longest of
/// two intervals has ten to thirty.
GridLines grid_lines(double low, double high, double longest);

}  // namespace whittle

// The one comparison of two frames. The program's `compare` and every test that holds one backend
// to another use it, so that all mean the same by "equal".
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "image/picture.h"
#include "trace/frame.h"

namespace whittle {

/// What still counts as equal.
struct CompareSettings {
  double distance_relative =
      1e-5;                     ///< of the larger distance, or of distance_floor if that is more
  double distance_floor = 0;    ///< model units; for orthographic views, whose distances may be 0
  double normal_degrees = 0.5;  ///< angle between the normals
};

/// What is seen at one pixel of both frames.
struct PixelDifference {
  int x = 0, y = 0;
  Hit a, b;
};

struct Comparison {
  int width_a = 0, height_a = 0, width_b = 0, height_b = 0;
  size_t pixels = 0;       ///< compared: all but the ignored; 0 if the sizes differ
  size_t ignored = 0;      ///< left out by the mask
  size_t differing = 0;    ///< pixels with any of the differences below
  size_t hit_differs = 0;  ///< a hit in one frame only
  size_t id_differs = 0;   ///< this and the next two: among the pixels hit in both frames
  size_t distance_differs = 0;
  size_t normal_differs = 0;
  double max_distance_error = 0;           ///< model units, over all pixels hit in both frames
  double max_relative_distance_error = 0;  ///< of the same measure as distance_relative
  double max_normal_degrees = 0;
  PixelDifference first;  ///< the first differing pixel, by rows; meaningful if differing > 0

  bool same_size() const { return width_a == width_b && height_a == height_b; }
  /// True if the frames agree. Frames of different size never do.
  bool equal() const { return same_size() && differing == 0; }
};

/// Compares all pixels but those whose entry in `ignore_mask` is not 0. Precondition: the mask is
/// empty or holds an entry for every pixel. Distances and normals that are not numbers differ from
/// everything.
Comparison compare(const Frame& a, const Frame& b, const CompareSettings& settings = {},
                   std::span<const uint8_t> ignore_mask = {});

/// The comparison in words: one line if equal, else one line a kind of difference and the first
/// differing pixel with both facts. No newline at the end.
std::string describe(const Comparison& comparison);

/// Where the frames differ: hit red, id orange, distance violet, normal blue (the first of these
/// that applies), equal pixels grey (hit) and white (background), ignored ones pale yellow. Frames
/// of different size give an empty picture.
Picture difference_picture(const Frame& a, const Frame& b, const CompareSettings& settings = {},
                           std::span<const uint8_t> ignore_mask = {});

}  // namespace whittle

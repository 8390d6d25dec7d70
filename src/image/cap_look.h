// What caps look like, where a section cuts through a solid: lit flatly, so that they read as what
// they are and not as a face of the part, and hatched if asked, as in a technical drawing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/shade_lanes.h"
#include "model/instances.h"
#include "model/model.h"

namespace whittle {

/// How much of a hatch's line is at a place of the picture, 0 to 1: parallel lines, as far apart as
/// `spacing` and as wide as `line`, pixels, seen through a pixel's width. `kind` says which way
/// they go: 45 degrees, 135, and then others in between.
float hatch_line(PixelPosition place, uint32_t kind, float spacing, float line);

class CapLook {
 public:
  CapLook(const Cut& ids, Style style);

  /// From now on caps are hatched, another way for each colour, in the order of their statements.
  /// Lines are a fiftieth of the picture's smaller side apart, and at least 6 pixels.
  void hatch(std::span<const Appearance> looks, int width, int height);

  bool any(std::span<const Hit> hits) const;
  /// Paints those of the hits that lie on caps, seen through as many places. `openness` as in
  /// Reaching: caps in a corner are a little darker. Only the base colours of `shader` are used.
  void paint(std::span<const Hit> hits, std::span<const PixelPosition> places,
             std::span<const float> openness, const ShadeParameters& shader, Colors& colors) const;

 private:
  Cut ids_;
  bool is_linear_;
  std::vector<uint8_t> kinds_;  ///< of hatches, by statement; or empty
  float spacing_ = 0, line_ = 0;
};

}  // namespace whittle

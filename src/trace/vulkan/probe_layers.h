// Positions in a picture, sorted into layers with at most one position a pixel. One layer is what
// one drawing can look at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/pixel_rect.h"
#include "trace/tracer.h"

namespace whittle {

struct ProbeLayer {
  struct Place {
    uint32_t position;  ///< number among all positions
    uint32_t pixel;     ///< of the tile, row by row
  };
  std::vector<Place> places;
  std::vector<PixelPosition> positions;  ///< one a pixel of the tile
  std::vector<float> depth;              ///< 1 where a pixel has a place, else 0: nothing is seen
};

/// The pixels that hold the positions. They need not lie in the picture. Precondition: there are
/// positions, all finite and within 2^30.
PixelRect pixels_of(std::span<const PixelPosition> positions);

/// All positions that lie in the tile, as few layers as can be.
std::vector<ProbeLayer> probe_layers(std::span<const PixelPosition> positions,
                                     const PixelRect& tile);

}  // namespace whittle

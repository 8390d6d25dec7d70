// A stack of sections as one SVG.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "flat/polygons.h"

namespace whittle {

/// A section, and where it is.
struct SlicedLayer {
  double z = 0;
  std::vector<Contour> loops;
};

/// One group a layer, in their order: `layer0` and so on, with its height as `data-z`, and in it
/// one path unless the layer is empty. `page` is what all lie in.
std::string write_layers(std::span<const SlicedLayer> layers, const Rect& page);

}  // namespace whittle

// The paper's rules, as the program's --paper sets them.
#pragma once

#include "whittle/renderer.h"

namespace whittle {

inline RendererSettings paper_settings(Backend backend) {
  RendererSettings settings;
  settings.backend = backend;
  settings.pixel_threshold = 1;
  settings.subdivide.leaf_size = 2;
  settings.subdivide.leaf = LeafRule::kPrimitives;
  settings.subdivide.split = SplitRule::kXyz;
  settings.subdivide.ignore_small = true;
  return settings;
}

}  // namespace whittle

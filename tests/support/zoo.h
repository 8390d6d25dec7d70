// Small scenes, each about one thing, with answers worked out on paper.
#pragma once

#include <string>
#include <vector>

#include "base/box.h"

namespace whittle {

/// What one ray must see.
struct KnownRay {
  Vec3 eye, direction;  ///< any length
  uint32_t id = 0;      ///< 0: nothing
  double distance = kInfinity;
  Vec3 normal;  ///< any length; outward
};

struct ZooScene {
  std::string name;  ///< unique, lower_case
  std::string text;  ///< .csg
  std::vector<KnownRay> rays;
};

/// All scenes, in a fixed order.
std::vector<ZooScene> zoo();

}  // namespace whittle

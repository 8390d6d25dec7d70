// Volume, surface, centre and inertia of a solid, and of the parts of it that have one colour.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/result.h"
#include "base/workers.h"
#include "model/model.h"

namespace whittle {

/// A number, and how far from it the truth can be at most.
struct Bounded {
  double value = 0, bound = 0;
};

/// Lengths are model units. Of a solid without volume there is neither centre nor inertia.
struct Mass {
  Bounded volume, area;
  Vec3 centroid;              ///< world coordinates
  double centroid_bound = 0;  ///< along each axis; infinite if the volume may be 0
  /// About the centroid, of a density of 1: xx, yy, zz, and minus the integrals of yz, xz, xy.
  Vec3 moments, products;
  double inertia_bound = 0;  ///< of each of the six

  bool is_facetted = false;  ///< all surfaces are flat; bounds are rounding
  bool is_within = true;     ///< the volume's bound is what was asked for
};

struct ColorMass {
  std::optional<Rgba> color;  ///< none: what has no color()
  Mass mass;
};

struct Measures {
  Mass whole;
  /// In the order in which they first stand in the file. Together they are the whole; each point
  /// has one colour (material.h). Those without volume are left out. Empty if there is only one, or
  /// if there are more than kMostColors.
  std::vector<ColorMass> colors;
  size_t color_count = 0;  ///< of primitives of the solid
};
inline constexpr size_t kMostColors = 64;

struct MeasureSettings {
  double within = 1e-6;  ///< of the volume, where surfaces are curved
  int threads = 0;       ///< 0: all
  bool by_color = true;
  std::function<void(double)> progress{};  ///< is told the share of the present step
};

/// A kInput error, without the file's name, if the model is flat or has no end.
Result<Measures> measure(const Model& model, const MeasureSettings& settings = {});

}  // namespace whittle

// What can be chosen, for the public API and for all that stands below it.
#pragma once

#include <cstddef>

namespace whittle {

/// What finds out what rays see. The facts do not depend on it.
enum class Backend {
  kAuto,          ///< the fastest that works here
  kCpu,           ///< cells, walked by every ray
  kVulkanRaster,  ///< cells, rasterised and solved on a Vulkan device
  kOracle,        ///< the reference: exact, and slow
};

/// Which shaders of Backend::kVulkanRaster solve the cells. The result is the same.
enum class ShaderCases {
  kSpecialised,  ///< one for each case of leaves, as in the paper
  kUnified,      ///< one for all
};

enum class Style {
  kStudio,    ///< as a photograph of a product: ambient occlusion, lines at edges, a ground
  kPlain,     ///< soft lights fixed to the camera, computed in linear light; no rays but the eye's
  kBlinn,     ///< one positional light, Blinn highlight; values are display values, as in the paper
  kOpenscad,  ///< what OpenSCAD's --render draws; it knows no color()
};

/// What Style::kStudio spends on a picture (docs/performance.md has the milliseconds).
enum class Quality {
  kDraft,  ///< lights and lines alone
  kGood,   ///< a few rays of ambient occlusion, shared by neighbouring pixels
  kBest,   ///< 16 of them from each pixel, and more rays at edges
};

/// What becomes of spheres, cylinders and other curves.
enum class Curves {
  kAuto,          ///< $fn > 0 asks for facets and gets them; $fn = 0 is a true curve
  kFacets,        ///< OpenSCAD's polyhedra everywhere
  kSmooth,        ///< true curves everywhere
  kOpenscad2021,  ///< kFacets as OpenSCAD 2021.01 has them: the fraction of $fn is cut off
};

/// What is too much. A limit that is passed is an error that names it (why these:
/// docs/decisions/0010-limits.md).
struct ReadLimits {
  std::size_t bytes = 500'000'000;  ///< of text; less than 4 GiB
  std::size_t depth = 1'000'000;    ///< statements inside statements
  std::size_t nodes = 20'000'000;   ///< statements, those dropped by `*` not counted
  std::size_t values = 10'000'000;  ///< in one statement: numbers, strings, vectors, names for them
  std::size_t facets = 2'100'000;   ///< flat faces of all shapes together
};

}  // namespace whittle

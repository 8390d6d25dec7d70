// What can be chosen of the vulkan-raster backend, and what it says of its work.
#pragma once

#include <cstdint>
#include <string>

#include "whittle/options.h"

namespace whittle {

/// The numbers that shaders compute with.
enum class ShaderNumbers { kAuto, kDouble, kFloat };

/// How shaders read the scene. Storage buffers are slow on Mesa's software device, texel buffers
/// are small on others.
enum class ShaderReads { kAuto, kTexels, kStorage };

struct RasterSettings {
  std::string device;  ///< number or part of a name; empty: the best
  ShaderNumbers numbers = ShaderNumbers::kAuto;
  ShaderReads reads = ShaderReads::kAuto;
  ShaderCases shaders = ShaderCases::kSpecialised;
  bool culling = true;  ///< cells behind others are left out; for measurements it can be off
  /// Of a picture whose cells are refined while others are drawn, the first batch is closed after
  /// so many milliseconds of refining, each later one after twice as many as the one before:
  /// drawing a batch costs something, however little is in it.
  double first_batch_ms = 3;
  bool validate = false;  ///< use Vulkan's validation layer, and keep what it says
};

/// What the last render() did.
struct RasterStats {
  uint64_t cells = 0;         ///< on the device
  uint64_t in_view = 0;       ///< of them, those that the camera may see,
  uint64_t drawn_first = 0;   ///< those drawn because they are probably seen,
  uint64_t drawn_second = 0;  ///< and those that these did not hide; tiles add up
  uint32_t draws = 0;         ///< calls that did it
  uint64_t in_doubt = 0;      ///< pixels that shaders in floats left to the second look
  double second_ms = 0;       ///< which took so long
  uint64_t batches = 0;       ///< in which cells came, if they were refined while others were drawn
  double first_ms = 0;        ///< then, from the beginning until the first of them were drawn
  double order_ms = 0;        ///< on the host: cells sorted front to back
  double draw_ms = 0;         ///< on the device, 0 if it cannot tell: cells to pixels
  double resolve_ms = 0;      ///< pixels to facts
};

}  // namespace whittle

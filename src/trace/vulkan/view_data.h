// What shaders know of the camera: the uniform block of shaders/view.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lower/scene.h"
#include "trace/camera.h"
#include "trace/pixel_rect.h"
#include "trace/vulkan/shader_constants.h"

namespace whittle {

/// Laid out as std140 has it.
struct ViewData {
  std::array<uint32_t, 2 * shader::kViewNumbers> numbers{};  ///< two words each
  std::array<int32_t, 2> tile_origin{}, tile_size{};
  uint32_t orthographic = 0;
  uint32_t probes = 0;
  float margin = 0;
  uint32_t picture = 0;  ///< its number
};
static_assert(offsetof(ViewData, tile_origin) == 192 && offsetof(ViewData, tile_size) == 200 &&
              offsetof(ViewData, orthographic) == 208 && offsetof(ViewData, picture) == 220 &&
              sizeof(ViewData) == 224);

/// The camera's eye in the scene's local coordinates.
Vec3 local_eye(const Scene& scene, const Camera& camera);

/// So far ahead of the eye, which is in local coordinates, lies what places are relative to in
/// floats: near to the region, and no farther from the eye than that.
double reference_ahead(const Box& region, const Camera& camera, Vec3 eye);

/// `cell_margin`: leaves are right so far beyond their cells. `margin`: pixels that boxes are grown
/// by on the screen. `probes`: every pixel of the tile looks at a place of its own.
ViewData make_view_data(const Scene& scene, double cell_margin, const Camera& camera,
                        const PixelRect& tile, bool doubles, bool probes, double margin);

}  // namespace whittle

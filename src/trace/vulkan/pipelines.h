// The pipelines of vulkan-raster and what they bind.
#pragma once

#include <array>
#include <cstddef>

#include "gpu/memory.h"
#include "gpu/owned.h"
#include "trace/vulkan/leaf_case.h"

namespace whittle {

/// What the device draws into.
inline constexpr VkFormat kSeenFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// One cell to draw, as an instance: the inputs of shaders/cells.vert.
struct CellInstance {
  uint32_t cell;
  float depth;  ///< 0 to 1, rising from front to back
};
static_assert(offsetof(CellInstance, depth) == 4 && sizeof(CellInstance) == 8);

/// Vertices of a cell's box: `kBoxIndices` indices draw the faces that the eye sees; those from
/// there on, `kSquareIndices` of them, a square over the whole picture.
inline constexpr std::array<uint16_t, 24> kIndices = {0, 1, 2,  2,  1, 3,  4,  5,  6,  6,  5,  7,
                                                      8, 9, 10, 10, 9, 11, 12, 13, 14, 14, 13, 15};
inline constexpr uint32_t kBoxIndices = 18, kSquareIndices = 6;

struct Pipelines {
  gpu::Owned<VkDescriptorSetLayout> set_layout;
  gpu::Owned<VkPipelineLayout> layout;
  gpu::Owned<VkShaderModule> cells, visible;
  std::array<gpu::Owned<VkPipeline>, kLeafCases> draw;  ///< those that were needed so far
  gpu::Owned<VkPipeline> resolve, pyramid, hidden;
};
/// All but the drawing ones.
Result<Pipelines> make_pipelines(const gpu::Device& device, bool doubles, bool storage);
/// Adds the one that draws such leaves.
Status add_draw(const gpu::Device& device, LeafCase leaf, Pipelines& pipelines);

/// What kind of descriptor a binding has.
VkDescriptorType descriptor_type(uint32_t binding, bool storage);

}  // namespace whittle

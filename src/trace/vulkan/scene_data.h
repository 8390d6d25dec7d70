// The scene on the device: the buffers that the shaders read half-spaces, cells and literals from.
#pragma once

#include <cstdint>
#include <span>

#include "gpu/commands.h"
#include "trace/vulkan/bindings.h"

namespace whittle {

class SceneData {
 public:
  /// Sends the half-spaces and binds all buffers. The arguments must outlive it.
  static Result<SceneData> make(const RasterDevice& device, gpu::Commands& commands,
                                const Bindings& bindings, std::span<const uint32_t> half_spaces);

  /// Sends cells and words behind those that are there. Not while the device reads them. A kMachine
  /// error if it has no room for them.
  Status append(std::span<const uint32_t> cells, std::span<const uint32_t> words);

 private:
  /// Words in a buffer that grows.
  struct Store {
    uint32_t binding;
    VkFormat format;
    ReadBuffer to;
    VkDeviceSize used = 0;  ///< bytes
  };
  Status append(Store& store, std::span<const uint32_t> words);
  Status grow(Store& store, VkDeviceSize bytes);

  const RasterDevice* device_ = nullptr;
  gpu::Commands* commands_ = nullptr;
  const Bindings* bindings_ = nullptr;
  Store half_spaces_{shader::kHalfSpacesBinding, VK_FORMAT_R32G32B32A32_UINT, {}, 0};
  Store cells_{shader::kCellsBinding, VK_FORMAT_R32G32B32A32_UINT, {}, 0};
  Store words_{shader::kWordsBinding, VK_FORMAT_R32_UINT, {}, 0};
};

}  // namespace whittle

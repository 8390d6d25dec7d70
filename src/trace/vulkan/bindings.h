// What the pipelines read and write: one descriptor set, and the buffers that are texel or storage
// buffers, whichever the device reads faster.
#pragma once

#include "gpu/memory.h"
#include "trace/vulkan/raster_device.h"

namespace whittle {

/// A buffer that shaders read words from: a storage buffer, or a texel buffer with its view.
struct ReadBuffer {
  gpu::Buffer buffer;
  gpu::Owned<VkBufferView> view;
};

/// Makes one of at least that many bytes. `format`: of a texel. `usage`: what else it is for.
/// A kMachine error if the device has no such large ones.
Result<ReadBuffer> make_read_buffer(const RasterDevice& device, VkDeviceSize bytes, VkFormat format,
                                    VkBufferUsageFlags usage, gpu::Placement placement);

/// One set of bindings. The device must outlive it, and what is bound each command that uses it.
class Bindings {
 public:
  static Result<Bindings> make(const RasterDevice& device);

  void bind(uint32_t binding, const gpu::Buffer& buffer) const;
  void bind(uint32_t binding, const ReadBuffer& buffer) const;
  void bind(uint32_t binding, const gpu::Image& image) const;

  /// For all commands of that kind after this one.
  void use(VkCommandBuffer commands, VkPipelineBindPoint kind) const;

 private:
  VkWriteDescriptorSet write_to(uint32_t binding) const;

  const RasterDevice* device_ = nullptr;
  gpu::Owned<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace whittle

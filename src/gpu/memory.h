// Buffers and images with memory of their own. Few and large ones are meant.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "gpu/device.h"
#include "gpu/owned.h"

namespace whittle::gpu {

enum class Placement {
  kDevice,  ///< near the device; the host may not reach it
  kUpload,  ///< the host writes, the device reads
  kRead,    ///< the device writes, the host reads
};

class Buffer {
 public:
  /// `bytes` > 0.
  static Result<Buffer> make(const Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage,
                             Placement placement);

  VkBuffer handle() const { return buffer_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  /// Where the host can read and write it; null if it cannot. Coherent: nothing need be flushed.
  void* mapped() const { return mapped_; }

 private:
  Owned<VkDeviceMemory> memory_;  // outlives the buffer
  Owned<VkBuffer> buffer_;
  VkDeviceSize bytes_ = 0;
  void* mapped_ = nullptr;
};

/// A two-dimensional image of one level and layer, with a view of all of it.
class Image {
 public:
  static Result<Image> make(const Device& device, VkFormat format, uint32_t width, uint32_t height,
                            VkImageUsageFlags usage);

  VkImage handle() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }
  VkImageAspectFlags aspect() const { return aspect_; }

 private:
  Owned<VkDeviceMemory> memory_;
  Owned<VkImage> image_;
  Owned<VkImageView> view_;
  VkImageAspectFlags aspect_ = 0;
};

/// A view of a buffer as an array of texels.
Result<Owned<VkBufferView>> make_texel_view(const Device& device, const Buffer& buffer,
                                            VkFormat format);

}  // namespace whittle::gpu

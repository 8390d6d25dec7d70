// Work for the device: recorded, submitted, waited for, and timed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gpu/memory.h"

namespace whittle::gpu {

/// One command buffer that is recorded and run again and again. The device must outlive it.
class Commands {
 public:
  /// Room for that many timestamps in one recording.
  static Result<Commands> make(const Device& device, uint32_t timestamps);

  /// Starts a recording; what was recorded before is gone.
  Result<VkCommandBuffer> begin();
  /// Ends it, runs it and waits for its end.
  Status run();

  /// Records a timestamp: taken when all that was recorded before is done. Numbers rise from 0.
  void stamp();
  /// After run(): milliseconds from each timestamp to the next; empty where the queue has none.
  std::vector<double> intervals() const;

 private:
  const Device* device_ = nullptr;
  Owned<VkCommandPool> pool_;
  Owned<VkFence> fence_;
  Owned<VkQueryPool> queries_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  uint32_t most_stamps_ = 0, stamps_ = 0;
};

/// Copies bytes into a buffer, from byte `at` on, which has room for them and, unless the host
/// reaches it, VK_BUFFER_USAGE_TRANSFER_DST_BIT. Done when it returns.
Status upload(const Device& device, Commands& commands, Buffer& to,
              std::span<const std::byte> bytes, VkDeviceSize at = 0);

/// All that `before` wrote is there for `after` to read.
void wait_for(VkCommandBuffer commands, VkPipelineStageFlags2 before, VkAccessFlags2 wrote,
              VkPipelineStageFlags2 after, VkAccessFlags2 reads);

/// One image on its way from one use to the next.
struct ImageUse {
  VkImageLayout layout;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
};
void change_use(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                const ImageUse& before, const ImageUse& after);

}  // namespace whittle::gpu

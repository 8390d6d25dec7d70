#include "gpu/commands.h"

#include "base/result.h"

namespace whittle::gpu {
namespace {

/// A device that takes longer hangs. Software devices are slow.
constexpr uint64_t kPatienceNanoseconds = 600'000'000'000;

}  // namespace

Result<Commands> Commands::make(const Device& device, uint32_t timestamps) {
  Commands made;
  made.device_ = &device;
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool_info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  VkResult result = vkCreateCommandPool(device.handle(), &pool_info, nullptr, &pool);
  if (result != VK_SUCCESS) return device.error(result, "make commands");
  made.pool_ = Owned<VkCommandPool>(device.handle(), pool, vkDestroyCommandPool);

  VkCommandBufferAllocateInfo buffer_info{};
  buffer_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  buffer_info.commandPool = pool;
  buffer_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer_info.commandBufferCount = 1;
  result = vkAllocateCommandBuffers(device.handle(), &buffer_info, &made.buffer_);
  if (result != VK_SUCCESS) return device.error(result, "make commands");

  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  result = vkCreateFence(device.handle(), &fence_info, nullptr, &fence);
  if (result != VK_SUCCESS) return device.error(result, "make a fence");
  made.fence_ = Owned<VkFence>(device.handle(), fence, vkDestroyFence);

  if (timestamps > 0 && device.timestamp_bits() > 0) {
    VkQueryPoolCreateInfo query_info{};
    query_info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    query_info.queryCount = timestamps;
    VkQueryPool queries = VK_NULL_HANDLE;
    result = vkCreateQueryPool(device.handle(), &query_info, nullptr, &queries);
    if (result != VK_SUCCESS) return device.error(result, "take the time");
    made.queries_ = Owned<VkQueryPool>(device.handle(), queries, vkDestroyQueryPool);
    made.most_stamps_ = timestamps;
  }
  return made;
}

Result<VkCommandBuffer> Commands::begin() {
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  const VkResult result = vkBeginCommandBuffer(buffer_, &info);
  if (result != VK_SUCCESS) return device_->error(result, "record commands");
  stamps_ = 0;
  if (queries_) vkCmdResetQueryPool(buffer_, queries_.get(), 0, most_stamps_);
  return buffer_;
}

Status Commands::run() {
  VkResult result = vkEndCommandBuffer(buffer_);
  if (result != VK_SUCCESS) return device_->error(result, "record commands");
  VkCommandBufferSubmitInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  commands.commandBuffer = buffer_;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  result = vkQueueSubmit2(device_->queue(), 1, &info, fence_.get());
  if (result != VK_SUCCESS) return device_->error(result, "submit work");
  result = vkWaitForFences(device_->handle(), 1, fence_.address(), VK_TRUE, kPatienceNanoseconds);
  if (result == VK_SUCCESS) result = vkResetFences(device_->handle(), 1, fence_.address());
  if (result != VK_SUCCESS) return device_->error(result, "finish work");
  return Done{};
}

void Commands::stamp() {
  if (!queries_) return;
  WHITTLE_CHECK(stamps_ < most_stamps_);
  vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_.get(), stamps_++);
}

std::vector<double> Commands::intervals() const {
  std::vector<double> result;
  if (stamps_ < 2) return result;
  std::vector<uint64_t> ticks(stamps_);
  if (vkGetQueryPoolResults(device_->handle(), queries_.get(), 0, stamps_,
                            ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                            VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
    return result;
  const uint64_t valid = device_->timestamp_bits() >= 64
                             ? ~uint64_t(0)
                             : (uint64_t(1) << device_->timestamp_bits()) - 1;
  const double milliseconds = double(device_->limits().timestampPeriod) * 1e-6;
  for (size_t i = 1; i < ticks.size(); ++i)
    result.push_back(double((ticks[i] - ticks[i - 1]) & valid) * milliseconds);
  return result;
}

Status upload(const Device& device, Commands& commands, Buffer& to,
              std::span<const std::byte> bytes, VkDeviceSize at) {
  if (bytes.empty()) return Done{};
  if (to.mapped() != nullptr) {
    std::memcpy(static_cast<std::byte*>(to.mapped()) + at, bytes.data(), bytes.size());
    return Done{};
  }
  const Result<Buffer> from =
      Buffer::make(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Placement::kUpload);
  if (!from) return from.error();
  std::memcpy(from->mapped(), bytes.data(), bytes.size());
  Result<VkCommandBuffer> recording = commands.begin();
  if (!recording) return recording.error();
  const VkBufferCopy copy{0, at, bytes.size()};
  vkCmdCopyBuffer(*recording, from->handle(), to.handle(), 1, &copy);
  wait_for(*recording, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
           VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT);
  return commands.run();
}

void wait_for(VkCommandBuffer commands, VkPipelineStageFlags2 before, VkAccessFlags2 wrote,
              VkPipelineStageFlags2 after, VkAccessFlags2 reads) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = before;
  barrier.srcAccessMask = wrote;
  barrier.dstStageMask = after;
  barrier.dstAccessMask = reads;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

void change_use(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                const ImageUse& before, const ImageUse& after) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = before.stage;
  barrier.srcAccessMask = before.access;
  barrier.dstStageMask = after.stage;
  barrier.dstAccessMask = after.access;
  barrier.oldLayout = before.layout;
  barrier.newLayout = after.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, 1, 0, 1};
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace whittle::gpu

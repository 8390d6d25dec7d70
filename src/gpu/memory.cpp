#include "gpu/memory.h"

#include <array>
#include <optional>

namespace whittle::gpu {
namespace {

/// The first kind of memory that is allowed and has all the wanted properties.
std::optional<uint32_t> find_kind(const Device& device, uint32_t allowed,
                                  VkMemoryPropertyFlags wanted) {
  const VkPhysicalDeviceMemoryProperties& memory = device.memory();
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
      return i;
  return std::nullopt;
}

Result<Owned<VkDeviceMemory>> allocate(const Device& device, const VkMemoryRequirements& needs,
                                       Placement placement, bool& is_mappable) {
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  // The best first.
  const std::array<VkMemoryPropertyFlags, 2> wanted =
      placement == Placement::kDevice
          ? std::array<VkMemoryPropertyFlags, 2>{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}
      : placement == Placement::kUpload
          ? std::array<VkMemoryPropertyFlags, 2>{kHost | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kHost}
          : std::array<VkMemoryPropertyFlags, 2>{kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kHost};
  std::optional<uint32_t> kind;
  for (const VkMemoryPropertyFlags flags : wanted)
    if (!kind) kind = find_kind(device, needs.memoryTypeBits, flags);
  if (!kind) return device.error(VK_ERROR_OUT_OF_DEVICE_MEMORY, "find memory");
  is_mappable = (device.memory().memoryTypes[*kind].propertyFlags & kHost) == kHost;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = *kind;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(device.handle(), &info, nullptr, &memory);
  if (result != VK_SUCCESS) return device.error(result, "get memory");
  return Owned<VkDeviceMemory>(device.handle(), memory, vkFreeMemory);
}

}  // namespace

Result<Buffer> Buffer::make(const Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage,
                            Placement placement) {
  Buffer made;
  made.bytes_ = bytes;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkResult result = vkCreateBuffer(device.handle(), &info, nullptr, &buffer);
  if (result != VK_SUCCESS) return device.error(result, "make a buffer");
  made.buffer_ = Owned<VkBuffer>(device.handle(), buffer, vkDestroyBuffer);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
  bool is_mappable = false;
  Result<Owned<VkDeviceMemory>> memory = allocate(device, needs, placement, is_mappable);
  if (!memory) return memory.error();
  made.memory_ = *std::move(memory);
  result = vkBindBufferMemory(device.handle(), buffer, made.memory_.get(), 0);
  if (result == VK_SUCCESS && is_mappable)
    result = vkMapMemory(device.handle(), made.memory_.get(), 0, VK_WHOLE_SIZE, 0, &made.mapped_);
  if (result != VK_SUCCESS) return device.error(result, "use memory");
  return made;
}

Result<Image> Image::make(const Device& device, VkFormat format, uint32_t width, uint32_t height,
                          VkImageUsageFlags usage) {
  Image made;
  made.aspect_ =
      format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {width, height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  VkImage image = VK_NULL_HANDLE;
  VkResult result = vkCreateImage(device.handle(), &info, nullptr, &image);
  if (result != VK_SUCCESS) return device.error(result, "make an image");
  made.image_ = Owned<VkImage>(device.handle(), image, vkDestroyImage);
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device.handle(), image, &needs);
  bool is_mappable = false;
  Result<Owned<VkDeviceMemory>> memory = allocate(device, needs, Placement::kDevice, is_mappable);
  if (!memory) return memory.error();
  made.memory_ = *std::move(memory);
  result = vkBindImageMemory(device.handle(), image, made.memory_.get(), 0);
  if (result != VK_SUCCESS) return device.error(result, "use memory");
  VkImageViewCreateInfo view_info{};
  view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view_info.image = image;
  view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = format;
  view_info.subresourceRange = {made.aspect_, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  result = vkCreateImageView(device.handle(), &view_info, nullptr, &view);
  if (result != VK_SUCCESS) return device.error(result, "look at an image");
  made.view_ = Owned<VkImageView>(device.handle(), view, vkDestroyImageView);
  return made;
}

Result<Owned<VkBufferView>> make_texel_view(const Device& device, const Buffer& buffer,
                                            VkFormat format) {
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer.handle();
  info.format = format;
  info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  const VkResult result = vkCreateBufferView(device.handle(), &info, nullptr, &view);
  if (result != VK_SUCCESS) return device.error(result, "look at a buffer");
  return Owned<VkBufferView>(device.handle(), view, vkDestroyBufferView);
}

}  // namespace whittle::gpu

#include "trace/vulkan/bindings.h"

#include <bit>

namespace whittle {
namespace {

/// Mesa's software device compiles shaders anew for texel buffers whose size in bytes is a power of
/// two, or has zeros in bits 8 to 15 (Mesa 22.3 takes these for the number of levels), and for
/// those of which this is not so. These never are, so it compiles once.
VkDeviceSize room_for(VkDeviceSize bytes) {
  constexpr VkDeviceSize kStep = 256;
  VkDeviceSize room = (bytes / kStep + 1) * kStep;
  while ((room & 0xff00) == 0 || std::has_single_bit(room)) room += kStep;
  return room;
}

}  // namespace

Result<ReadBuffer> make_read_buffer(const RasterDevice& device, VkDeviceSize bytes, VkFormat format,
                                    VkBufferUsageFlags usage, gpu::Placement placement) {
  const VkPhysicalDeviceLimits& limits = device.gpu().limits();
  const VkDeviceSize texel = format == VK_FORMAT_R32_UINT            ? 4
                             : format == VK_FORMAT_R32G32B32A32_UINT ? 16
                                                                     : 8;
  const VkDeviceSize room = room_for(bytes);
  const VkDeviceSize most = device.storage() ? VkDeviceSize(limits.maxStorageBufferRange)
                                             : limits.maxTexelBufferElements * texel;
  if (room > most) {
    return Error{ErrorKind::kMachine,
                 device.gpu().info().name + ": the cells are too many for one of its buffers"};
  }
  usage |= device.storage() ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
                            : VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  ReadBuffer made;
  Result<gpu::Buffer> buffer = gpu::Buffer::make(device.gpu(), room, usage, placement);
  if (!buffer) return buffer.error();
  made.buffer = *std::move(buffer);
  if (device.storage()) return made;
  Result<gpu::Owned<VkBufferView>> view = gpu::make_texel_view(device.gpu(), made.buffer, format);
  if (!view) return view.error();
  made.view = *std::move(view);
  return made;
}

Result<Bindings> Bindings::make(const RasterDevice& device) {
  Bindings made;
  made.device_ = &device;
  const VkDevice handle = device.gpu().handle();
  std::array<VkDescriptorPoolSize, shader::kBindings> sizes{};
  for (uint32_t i = 0; i < shader::kBindings; ++i)
    sizes[i] = {descriptor_type(i, device.storage()), 1};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = shader::kBindings;
  pool_info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkResult result = vkCreateDescriptorPool(handle, &pool_info, nullptr, &pool);
  if (result != VK_SUCCESS) return device.gpu().error(result, "make bindings");
  made.pool_ = {handle, pool, vkDestroyDescriptorPool};
  VkDescriptorSetAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = device.pipelines().set_layout.address();
  result = vkAllocateDescriptorSets(handle, &allocate, &made.set_);
  if (result != VK_SUCCESS) return device.gpu().error(result, "make bindings");
  return made;
}

VkWriteDescriptorSet Bindings::write_to(uint32_t binding) const {
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = descriptor_type(binding, device_->storage());
  return write;
}

void Bindings::bind(uint32_t binding, const gpu::Buffer& buffer) const {
  const VkDescriptorBufferInfo info{buffer.handle(), 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write = write_to(binding);
  write.pBufferInfo = &info;
  vkUpdateDescriptorSets(device_->gpu().handle(), 1, &write, 0, nullptr);
}

void Bindings::bind(uint32_t binding, const ReadBuffer& buffer) const {
  if (device_->storage()) return bind(binding, buffer.buffer);
  VkWriteDescriptorSet write = write_to(binding);
  write.pTexelBufferView = buffer.view.address();
  vkUpdateDescriptorSets(device_->gpu().handle(), 1, &write, 0, nullptr);
}

void Bindings::bind(uint32_t binding, const gpu::Image& image) const {
  const VkDescriptorImageInfo info{VK_NULL_HANDLE, image.view(),
                                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write = write_to(binding);
  write.pImageInfo = &info;
  vkUpdateDescriptorSets(device_->gpu().handle(), 1, &write, 0, nullptr);
}

void Bindings::use(VkCommandBuffer commands, VkPipelineBindPoint kind) const {
  vkCmdBindDescriptorSets(commands, kind, device_->pipelines().layout.get(), 0, 1, &set_, 0,
                          nullptr);
}

}  // namespace whittle

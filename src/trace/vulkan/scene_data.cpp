#include "trace/vulkan/scene_data.h"

namespace whittle {

Result<SceneData> SceneData::make(const RasterDevice& device, gpu::Commands& commands,
                                  const Bindings& bindings, std::span<const uint32_t> half_spaces) {
  SceneData made;
  made.device_ = &device;
  made.commands_ = &commands;
  made.bindings_ = &bindings;
  // Shaders find something bound, even where there are no cells.
  constexpr VkDeviceSize kFirst = 1 << 16;
  for (Store* store : {&made.half_spaces_, &made.cells_, &made.words_})
    if (Status done = made.grow(*store, kFirst); !done) return done.error();
  if (Status done = made.append(made.half_spaces_, half_spaces); !done) return done.error();
  return made;
}

Status SceneData::append(std::span<const uint32_t> cells, std::span<const uint32_t> words) {
  if (Status done = append(cells_, cells); !done) return done;
  return append(words_, words);
}

Status SceneData::append(Store& store, std::span<const uint32_t> words) {
  if (Status done = grow(store, store.used + words.size_bytes()); !done) return done;
  Status done =
      gpu::upload(device_->gpu(), *commands_, store.to.buffer, std::as_bytes(words), store.used);
  if (done) store.used += words.size_bytes();
  return done;
}

Status SceneData::grow(Store& store, VkDeviceSize bytes) {
  if (bytes <= store.to.buffer.bytes()) return Done{};
  const auto make = [&](VkDeviceSize room) {
    return make_read_buffer(*device_, room, store.format,
                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                            gpu::Placement::kDevice);
  };
  // Half as much again, or if that is too much, what is needed.
  Result<ReadBuffer> larger = make(bytes + bytes / 2);
  if (!larger) larger = make(bytes);
  if (!larger) return larger.error();
  if (store.used > 0) {
    Result<VkCommandBuffer> recording = commands_->begin();
    if (!recording) return recording.error();
    const VkBufferCopy copy{0, 0, store.used};
    vkCmdCopyBuffer(*recording, store.to.buffer.handle(), larger->buffer.handle(), 1, &copy);
    gpu::wait_for(*recording, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
    if (Status done = commands_->run(); !done) return done;
  }
  store.to = *std::move(larger);
  bindings_->bind(store.binding, store.to);
  return Done{};
}

}  // namespace whittle

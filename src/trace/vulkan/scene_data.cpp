#include "trace/vulkan/scene_data.h"

#include <tuple>

namespace whittle {
namespace {

/// Ranks from front to back that a 32-bit float between 0 and 1 tells apart.
constexpr size_t kMostRanks = (size_t(1) << 24) - 1;

}  // namespace

Result<SceneData> SceneData::make(const RasterDevice& device, gpu::Commands& commands,
                                  const Bindings& bindings, const FlatCells& flat) {
  if (flat.cell_count() > kMostRanks)
    return Error{ErrorKind::kMachine, "more cells than a depth buffer can tell apart"};
  SceneData made;
  constexpr VkFormat kFours = VK_FORMAT_R32G32B32A32_UINT;
  for (auto [words, to, binding, format] :
       {std::tuple(&flat.half_spaces, &made.half_spaces_, kHalfSpacesBinding, kFours),
        std::tuple(&flat.cells, &made.cells_, kCellsBinding, kFours),
        std::tuple(&flat.words, &made.words_, kWordsBinding, VK_FORMAT_R32_UINT)}) {
    Result<ReadBuffer> buffer =
        make_read_buffer(device, words->size() * sizeof(uint32_t), format,
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::Placement::kDevice);
    if (!buffer) return buffer.error();
    *to = *std::move(buffer);
    if (Status done =
            gpu::upload(device.gpu(), commands, to->buffer, std::as_bytes(std::span(*words)));
        !done)
      return done.error();
    bindings.bind(binding, *to);
  }
  return made;
}

}  // namespace whittle

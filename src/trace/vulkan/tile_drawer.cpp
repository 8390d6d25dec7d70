#include "trace/vulkan/tile_drawer.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

namespace whittle {
namespace {

using gpu::Buffer;
using gpu::Image;
using gpu::Placement;

/// What the resolving shader writes for a pixel, and its workgroups' side.
static_assert(sizeof(Hit) == 20 && offsetof(Hit, id) == 4 && offsetof(Hit, normal) == 8);
constexpr uint32_t kGroupSide = 8;

/// Mesa's software device compiles shaders anew for images whose sides are powers of two, and for
/// those whose sides are not. These never are, so it compiles once.
uint32_t side_for(int pixels) {
  return std::has_single_bit(unsigned(pixels)) ? std::max(3u, unsigned(pixels) + 1)
                                               : unsigned(pixels);
}

constexpr gpu::ImageUse kUnused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, 0};
constexpr gpu::ImageUse kFilled{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr gpu::ImageUse kTested{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr gpu::ImageUse kDrawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                               VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                               VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr gpu::ImageUse kResolved{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                  VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr gpu::ImageUse kCopied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT};

}  // namespace

Result<TileDrawer> TileDrawer::make(RasterDevice& device, gpu::Commands& commands,
                                    const Bindings& bindings) {
  TileDrawer made;
  made.device_ = &device;
  made.commands_ = &commands;
  made.bindings_ = &bindings;
  if (Status done = made.make_buffer(made.view_, sizeof(ViewData),
                                     VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::kUpload);
      !done)
    return done.error();
  if (Status done = made.make_buffer(made.indices_, sizeof(kIndices),
                                     VK_BUFFER_USAGE_INDEX_BUFFER_BIT, Placement::kUpload);
      !done)
    return done.error();
  std::memcpy(made.indices_.mapped(), kIndices.data(), sizeof(kIndices));
  bindings.bind(kViewBinding, made.view_);
  if (Status done = made.resize(1, 1); !done) return done.error();
  return made;
}

Status TileDrawer::make_buffer(Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                               Placement placement) {
  Result<Buffer> made = Buffer::make(gpu(), bytes, usage, placement);
  if (!made) return made.error();
  buffer = *std::move(made);
  return Done{};
}

Status TileDrawer::resize(int width, int height) {
  if (width == width_ && height == height_) return Done{};
  width_ = height_ = 0;
  Result<Image> seen =
      Image::make(gpu(), kSeenFormat, side_for(width), side_for(height),
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  if (!seen) return seen.error();
  seen_ = *std::move(seen);
  Result<Image> depth =
      Image::make(gpu(), kDepthFormat, uint32_t(width), uint32_t(height),
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  if (!depth) return depth.error();
  depth_ = *std::move(depth);
  const VkDeviceSize pixels = VkDeviceSize(width) * VkDeviceSize(height);
  if (Status done = make_buffer(hits_, pixels * sizeof(Hit), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                Placement::kRead);
      !done)
    return done;
  Result<ReadBuffer> positions = make_read_buffer(*device_, pixels * sizeof(PixelPosition),
                                                  VK_FORMAT_R32G32_SFLOAT, 0, Placement::kUpload);
  if (!positions) return positions.error();
  positions_ = *std::move(positions);
  if (Status done = make_buffer(asked_, pixels * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                Placement::kUpload);
      !done)
    return done;
  bindings_->bind(kPositionsBinding, positions_);
  bindings_->bind(kHitsBinding, hits_);
  bindings_->bind(kSeenBinding, seen_);
  seen_copy_ = {};
  width_ = width;
  height_ = height;
  return Done{};
}

Status TileDrawer::draw(const ViewData& view, std::span<const VisibleCell> cells,
                        const ProbeLayer* layer, RasterStats& stats, const DrawPart& part) {
  if (cells.size() > kMostRanks - part.rank)
    return Error{ErrorKind::kMachine, "more cells than a depth buffer can tell apart"};
  if (part.is_first) {
    if (Status done = resize(view.tile_size[0], view.tile_size[1]); !done) return done;
    std::memcpy(view_.mapped(), &view, sizeof(view));
    if (layer != nullptr) {
      std::memcpy(positions_.buffer.mapped(), layer->positions.data(),
                  layer->positions.size() * sizeof(PixelPosition));
      std::memcpy(asked_.mapped(), layer->depth.data(), layer->depth.size() * sizeof(float));
    }
  }
  if (Status done = make_instances(cells, part.rank); !done) return done;
  if (part.is_dry) draws_.clear();
  if (!part.is_last && seen_copy_.bytes() == 0) {
    const VkDeviceSize pixels = VkDeviceSize(width_) * VkDeviceSize(height_);
    if (Status done = make_buffer(seen_copy_, pixels * sizeof(uint32_t),
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kRead);
        !done)
      return done;
  }

  stats.draws += uint32_t(draws_.size());
  Result<VkCommandBuffer> recording = commands_->begin();
  if (!recording) return recording.error();
  commands_->stamp();
  record_drawing(*recording, layer != nullptr, part);
  if (!part.is_last) record_copy_of_seen(*recording);
  commands_->stamp();
  if ((part.is_last && !part.is_dry) || part.wants_hits) record_resolving(*recording);
  commands_->stamp();
  if (Status done = commands_->run(); !done) return done;
  const std::vector<double> times = commands_->intervals();
  if (times.size() == 2) {
    stats.draw_ms += times[0];
    stats.resolve_ms += times[1];
  }
  return Done{};
}

/// Sorted by case, and front to back within each.
Status TileDrawer::make_instances(std::span<const VisibleCell> cells, uint32_t rank) {
  if (Status done = reserve(instances_, (cells.size() + 1) * sizeof(Instance),
                            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
      !done)
    return done;
  std::array<uint32_t, 2 * kLeafCases> next{};
  const auto draw_of = [&](const VisibleCell& cell) {
    return 2 * device_->shader_for(cell.leaf_case) + (cell.is_wide ? 0 : 1);
  };
  for (const VisibleCell& cell : cells) ++next[draw_of(cell)];
  draws_.clear();
  uint32_t first = 0;
  for (uint32_t i = 0; i < next.size(); ++i) {
    const uint32_t count = std::exchange(next[i], first);
    if (count == 0) continue;
    draws_.push_back({LeafCase(i / 2), i % 2 == 0, first, count});
    if (Status done = device_->need(LeafCase(i / 2)); !done) return done;
    first += count;
  }
  // Powers of two: every depth is exact.
  constexpr double kStep = 1.0 / (kMostRanks + 1);
  auto* const to = static_cast<Instance*>(instances_.mapped());
  for (const VisibleCell& cell : cells)
    to[next[draw_of(cell)]++] = {cell.cell, float(kStep * ++rank)};

  if (Status done =
          reserve(commands_of_draws_, (draws_.size() + 1) * sizeof(VkDrawIndexedIndirectCommand),
                  VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
      !done)
    return done;
  auto* const commands = static_cast<VkDrawIndexedIndirectCommand*>(commands_of_draws_.mapped());
  for (size_t i = 0; i < draws_.size(); ++i) {
    const Draw& draw = draws_[i];
    commands[i] = {draw.is_wide ? kSquareIndices : kBoxIndices, draw.count,
                   draw.is_wide ? kBoxIndices : 0, 0, 0};
  }
  return Done{};
}

/// Makes room in a buffer, half as much again as it has.
Status TileDrawer::reserve(Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage) {
  if (buffer.bytes() >= bytes) return Done{};
  return make_buffer(buffer, std::max(bytes, buffer.bytes() * 3 / 2), usage, Placement::kUpload);
}

void TileDrawer::record_drawing(VkCommandBuffer commands, bool has_asked, const DrawPart& part) {
  const VkExtent2D extent{uint32_t(width_), uint32_t(height_)};
  if (!part.is_first) {
    gpu::change_use(commands, depth_.handle(), depth_.aspect(), kTested, kTested);
  } else if (has_asked) {
    gpu::change_use(commands, depth_.handle(), depth_.aspect(), kUnused, kFilled);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    copy.imageExtent = {extent.width, extent.height, 1};
    vkCmdCopyBufferToImage(commands, asked_.handle(), depth_.handle(),
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    gpu::change_use(commands, depth_.handle(), depth_.aspect(), kFilled, kTested);
  } else {
    gpu::change_use(commands, depth_.handle(), depth_.aspect(), kUnused, kTested);
  }
  gpu::change_use(commands, seen_.handle(), seen_.aspect(), part.is_first ? kUnused : seen_use_,
                  kDrawn);
  seen_use_ = kDrawn;

  VkRenderingAttachmentInfo color{};
  color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  color.imageView = seen_.view();
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = part.is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingAttachmentInfo depth = color;
  depth.imageView = depth_.view();
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp =
      part.is_first && !has_asked ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  depth.storeOp = part.is_last ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
  depth.clearValue.depthStencil.depth = 1;
  VkRenderingInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea.extent = extent;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands, &rendering);
  const VkViewport viewport{0, 0, float(extent.width), float(extent.height), 0, 1};
  const VkRect2D scissor{{0, 0}, extent};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
  bindings_->use(commands, VK_PIPELINE_BIND_POINT_GRAPHICS);
  vkCmdBindIndexBuffer(commands, indices_.handle(), 0, VK_INDEX_TYPE_UINT16);
  const VkBuffer instances = instances_.handle();
  for (size_t i = 0; i < draws_.size(); ++i) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      device_->pipelines().draw[draws_[i].shader].get());
    // An offset, and not a first instance in the command: that would be one more feature to need.
    const VkDeviceSize first = draws_[i].first * sizeof(Instance);
    vkCmdBindVertexBuffers(commands, 0, 1, &instances, &first);
    vkCmdDrawIndexedIndirect(commands, commands_of_draws_.handle(),
                             i * sizeof(VkDrawIndexedIndirectCommand), 1, 0);
  }
  vkCmdEndRendering(commands);
}

void TileDrawer::record_copy_of_seen(VkCommandBuffer commands) {
  gpu::change_use(commands, seen_.handle(), seen_.aspect(), seen_use_, kCopied);
  seen_use_ = kCopied;
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {uint32_t(width_), uint32_t(height_), 1};
  vkCmdCopyImageToBuffer(commands, seen_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         seen_copy_.handle(), 1, &copy);
  gpu::wait_for(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

void TileDrawer::record_resolving(VkCommandBuffer commands) {
  gpu::change_use(commands, seen_.handle(), seen_.aspect(), seen_use_, kResolved);
  seen_use_ = kResolved;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_->pipelines().resolve.get());
  bindings_->use(commands, VK_PIPELINE_BIND_POINT_COMPUTE);
  const auto groups = [](int pixels) { return (uint32_t(pixels) + kGroupSide - 1) / kGroupSide; };
  vkCmdDispatch(commands, groups(width_), groups(height_), 1);
  gpu::wait_for(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                VK_ACCESS_2_HOST_READ_BIT);
}

}  // namespace whittle

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

/// What the resolving shader writes for a pixel.
static_assert(sizeof(Hit) == 4 * shader::kHitWords && offsetof(Hit, id) == 4 &&
              offsetof(Hit, normal) == 8);
using shader::kGroupSide;

/// Mesa's software device compiles shaders anew for images whose sides are powers of two, and for
/// those whose sides are not. These never are, so it compiles once.
uint32_t side_for(int pixels) {
  return std::has_single_bit(unsigned(pixels)) ? std::max(3u, unsigned(pixels) + 1)
                                               : unsigned(pixels);
}

/// Pixels to squares of shaders/pyramid.glsl, and what one workgroup does for each to workgroups:
/// both have that side.
constexpr uint32_t groups(int pixels) {
  return (uint32_t(pixels) + kGroupSide - 1) / kGroupSide;
}
constexpr int squares(int pixels) {
  return int(groups(pixels));
}

constexpr gpu::ImageUse kUnused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, 0};
constexpr gpu::ImageUse kFilled{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr gpu::ImageUse kTested{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr gpu::ImageUse kDrawn{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr gpu::ImageUse kMeasured{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                  VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
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
  bindings.bind(shader::kViewBinding, made.view_);
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
      Image::make(gpu(), kDepthFormat, side_for(width), side_for(height),
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                      VK_IMAGE_USAGE_SAMPLED_BIT);
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
  const VkDeviceSize pyramid =
      squares(width) * squares(height) + squares(squares(width)) * squares(squares(height));
  if (Status done = make_buffer(pyramid_, pyramid * sizeof(float),
                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kDevice);
      !done)
    return done;
  if (Status done = make_buffer(places_, (pixels + 1) * sizeof(uint32_t),
                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kUpload);
      !done)
    return done;
  bindings_->bind(shader::kPlacesBinding, places_);
  bindings_->bind(shader::kPyramidBinding, pyramid_);
  bindings_->bind(shader::kDepthsBinding, depth_);
  bindings_->bind(shader::kPositionsBinding, positions_);
  bindings_->bind(shader::kHitsBinding, hits_);
  bindings_->bind(shader::kSeenBinding, seen_);
  seen_copy_ = {};
  width_ = width;
  height_ = height;
  return Done{};
}

Status TileDrawer::make_last_seen(size_t cells) {
  const VkDeviceSize bytes = (cells + 1) * sizeof(uint32_t), old = last_seen_.bytes();
  if (old >= bytes) return Done{};
  Buffer before = std::move(last_seen_);
  if (Status done = make_buffer(last_seen_, std::max(bytes, old * 3 / 2),
                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kRead);
      !done)
    return done;
  auto* const to = static_cast<std::byte*>(last_seen_.mapped());
  if (old > 0) std::memcpy(to, before.mapped(), old);
  std::memset(to + old, 0, last_seen_.bytes() - old);
  bindings_->bind(shader::kLastSeenBinding, last_seen_);
  return Done{};
}

Status TileDrawer::draw(const ViewData& view, std::span<const VisibleCell> cells, size_t cell_count,
                        const ProbeLayer* layer, RasterStats& stats, const DrawPart& part) {
  if (Status done = resize(view.tile_size[0], view.tile_size[1]); !done) return done;
  if (Status done = make_last_seen(cell_count); !done) return done;
  const bool has_asked = layer != nullptr;
  const bool culls = device_->culling(), has_depth = has_asked || !part.is_first;
  const auto since = std::max(picture_, 2u) - 1;
  if (Status done =
          list_.fill(*device_, *bindings_, cells, part.rank,
                     {static_cast<const uint32_t*>(last_seen_.mapped()), cell_count}, since,
                     !culls      ? Hiding::kNone
                     : has_asked ? Hiding::kEverything
                                 : Hiding::kPicture);
      !done)
    return done;
  ViewData sent = view;
  sent.picture = picture_;
  std::memcpy(view_.mapped(), &sent, sizeof(sent));
  if (has_asked) {
    std::memcpy(positions_.buffer.mapped(), layer->positions.data(),
                layer->positions.size() * sizeof(PixelPosition));
    std::memcpy(asked_.mapped(), layer->depth.data(), layer->depth.size() * sizeof(float));
    auto* to = static_cast<uint32_t*>(places_.mapped());
    *to++ = uint32_t(layer->places.size());
    for (const ProbeLayer::Place& place : layer->places) *to++ = place.pixel;
  }
  if (!part.is_last && seen_copy_.bytes() == 0) {
    const VkDeviceSize pixels = VkDeviceSize(width_) * VkDeviceSize(height_);
    if (Status done = make_buffer(seen_copy_, pixels * sizeof(uint32_t),
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kRead);
        !done)
      return done;
  }

  Result<VkCommandBuffer> recording = commands_->begin();
  if (!recording) return recording.error();
  if (part.is_dry) return commands_->run();
  commands_->stamp();
  if (has_asked) record_asked(*recording);
  for (const DrawList::Pass pass : {DrawList::kFirst, DrawList::kSecond}) {
    if (pass == DrawList::kSecond && !culls) break;
    if (list_.is_tested(pass)) record_test(*recording, pass);
    const bool is_first = part.is_first && pass == DrawList::kFirst;
    record_drawing(*recording, pass, is_first, has_depth || pass == DrawList::kSecond);
  }
  if (!part.is_last) record_copy_of_seen(*recording);
  commands_->stamp();
  if (part.is_last || part.wants_hits) record_resolving(*recording, layer);
  commands_->stamp();
  if (Status done = commands_->run(); !done) return done;
  const std::vector<double> times = commands_->intervals();
  if (times.size() == 2) {
    stats.draw_ms += times[0];
    stats.resolve_ms += times[1];
  }
  stats.in_view += cells.size();
  stats.drawn_first += list_.drawn(DrawList::kFirst);
  if (culls) stats.drawn_second += list_.drawn(DrawList::kSecond);
  stats.draws += list_.size() * (culls ? 2 : 1);
  return Done{};
}

/// The depths that shut pixels.
void TileDrawer::record_asked(VkCommandBuffer commands) const {
  gpu::change_use(commands, depth_.handle(), depth_.aspect(), kUnused, kFilled);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
  copy.imageExtent = {uint32_t(width_), uint32_t(height_), 1};
  vkCmdCopyBufferToImage(commands, asked_.handle(), depth_.handle(),
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  gpu::change_use(commands, depth_.handle(), depth_.aspect(), kFilled, kTested);
}

/// Makes a pyramid of the depths so far, and leaves out of the pass what it hides.
void TileDrawer::record_test(VkCommandBuffer commands, DrawList::Pass pass) const {
  gpu::change_use(commands, depth_.handle(), depth_.aspect(), kTested, kMeasured);
  // What the test writes, the pass before has read.
  gpu::wait_for(commands,
                VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
                    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT |
                    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  bindings_->use(commands, VK_PIPELINE_BIND_POINT_COMPUTE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_->pipelines().pyramid.get());
  vkCmdDispatch(commands, groups(squares(width_)), groups(squares(height_)), 1);
  gpu::wait_for(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  list_.record_test(commands, pass);
  gpu::change_use(commands, depth_.handle(), depth_.aspect(), kMeasured, kTested);
}

void TileDrawer::record_drawing(VkCommandBuffer commands, DrawList::Pass pass, bool is_first,
                                bool has_depth) {
  const VkExtent2D extent{uint32_t(width_), uint32_t(height_)};
  gpu::change_use(commands, depth_.handle(), depth_.aspect(), has_depth ? kTested : kUnused,
                  kTested);
  gpu::change_use(commands, seen_.handle(), seen_.aspect(), is_first ? kUnused : seen_use_, kDrawn);
  seen_use_ = kDrawn;

  VkRenderingAttachmentInfo color{};
  color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  color.imageView = seen_.view();
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingAttachmentInfo depth = color;
  depth.imageView = depth_.view();
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = has_depth ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
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
  list_.record(commands, pass);
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

void TileDrawer::record_resolving(VkCommandBuffer commands, const ProbeLayer* layer) {
  gpu::change_use(commands, seen_.handle(), seen_.aspect(), seen_use_, kResolved);
  seen_use_ = kResolved;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_->pipelines().resolve.get());
  bindings_->use(commands, VK_PIPELINE_BIND_POINT_COMPUTE);
  constexpr uint32_t kGroup = kGroupSide * kGroupSide;
  if (layer != nullptr)
    vkCmdDispatch(commands, (uint32_t(layer->places.size()) + kGroup - 1) / kGroup, 1, 1);
  else
    vkCmdDispatch(commands, groups(width_), groups(height_), 1);
  gpu::wait_for(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                VK_ACCESS_2_HOST_READ_BIT);
}

}  // namespace whittle

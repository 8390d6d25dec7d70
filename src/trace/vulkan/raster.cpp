#include "trace/vulkan/raster.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "gpu/commands.h"
#include "trace/vulkan/flatten.h"
#include "trace/vulkan/front_to_back.h"
#include "trace/vulkan/probe_layers.h"
#include "trace/vulkan/raster_device.h"
#include "trace/vulkan/view_data.h"

namespace whittle {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Device;
using gpu::Image;
using gpu::Owned;
using gpu::Placement;

/// Ranks from front to back that a 32-bit float between 0 and 1 tells apart.
constexpr size_t kMostRanks = (size_t(1) << 24) - 1;
/// What the resolving shader writes for a pixel, and its workgroups' side.
static_assert(sizeof(Hit) == 20 && offsetof(Hit, id) == 4 && offsetof(Hit, normal) == 8);
constexpr uint32_t kGroupSide = 8;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// Mesa's software device compiles shaders anew for images whose sides are powers of two, and for
/// those whose sides are not. These never are, so it compiles once.
uint32_t side_for(int pixels) {
  return std::has_single_bit(unsigned(pixels)) ? std::max(3u, unsigned(pixels) + 1)
                                               : unsigned(pixels);
}

/// The like for buffers of texels: of their size in bytes it looks at that, and whether bits 8 to
/// 15 are zero (Mesa 22.3 takes these for the number of levels). These never are.
VkDeviceSize room_for(VkDeviceSize bytes) {
  constexpr VkDeviceSize kStep = 256;
  VkDeviceSize room = (bytes / kStep + 1) * kStep;
  while ((room & 0xff00) == 0 || std::has_single_bit(room)) room += kStep;
  return room;
}

/// Scene data in a buffer, with the view that shaders read it by, if they read texels.
struct SceneBuffer {
  Buffer buffer;
  Owned<VkBufferView> view;
};

class RasterTracerImpl final : public RasterTracer {
 public:
  RasterTracerImpl(const Scene& scene, std::shared_ptr<RasterDevice> device)
      : scene_(scene), shared_(std::move(device)) {}

  Status prepare(const CellTree& tree) {
    Result<FlatCells> flat = flatten(scene_, tree, shared_->doubles());
    if (!flat) return flat.error();
    flat_ = *std::move(flat);
    if (flat_.cell_count() > kMostRanks)
      return Error{ErrorKind::kMachine, "more cells than a depth buffer can tell apart"};

    Result<Commands> commands = Commands::make(device(), 3);
    if (!commands) return commands.error();
    commands_ = *std::move(commands);
    Result<Bindings> bindings = make_bindings(device(), shared_->pipelines(), shared_->storage());
    if (!bindings) return bindings.error();
    bindings_ = *std::move(bindings);

    for (auto [data, binding, format] :
         {std::tuple(&flat_.half_spaces, kHalfSpacesBinding, VK_FORMAT_R32G32B32A32_UINT),
          std::tuple(&flat_.cells, kCellsBinding, VK_FORMAT_R32G32B32A32_UINT),
          std::tuple(&flat_.words, kWordsBinding, VK_FORMAT_R32_UINT)})
      if (Status done = send(*data, binding, format); !done) return done;
    // The device has them now.
    flat_.half_spaces = {};
    cell_count_ = flat_.cell_count();
    flat_.cells = {};
    flat_.words = {};

    if (Status done = make_buffer(view_, sizeof(ViewData), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                  Placement::kUpload);
        !done)
      return done;
    if (Status done = make_buffer(indices_, sizeof(kIndices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                  Placement::kUpload);
        !done)
      return done;
    std::memcpy(indices_.mapped(), kIndices.data(), sizeof(kIndices));
    bind_buffer(kViewBinding, view_);
    return make_tile(1, 1);
  }

  const char* name() const override { return "vulkan-raster"; }
  Status status() const override { return status_; }
  RasterStats stats() const override { return stats_; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame(camera.width, camera.height);
    stats_ = {};
    stats_.cells = cell_count_;
    if (flat_.root == kNoChild) return frame;
    const std::vector<PixelRect> tiles = tiles_of(pixels_covering(camera, world_region()));
    for (size_t i = 0; i < tiles.size() && status_; ++i) {
      const PixelRect& tile = tiles[i];
      status_ = trace_tile(camera, tile, nullptr);
      if (!status_) break;
      for (int y = 0; y < tile.height(); ++y)
        std::memcpy(&frame.at(tile.x0, tile.y0 + y), traced() + size_t(y) * size_t(tile.width()),
                    size_t(tile.width()) * sizeof(Hit));
      if (progress) progress(double(i + 1) / double(tiles.size()));
    }
    if (!status_) return Frame(camera.width, camera.height);
    return frame;
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    std::fill(hits.begin(), hits.end(), Hit{});
    if (flat_.root == kNoChild || positions.empty()) return;
    for (const PixelRect& tile : tiles_of(pixels_of(positions))) {
      for (const ProbeLayer& layer : probe_layers(positions, tile)) {
        if (!status_) return;
        status_ = trace_tile(camera, tile, &layer);
        if (!status_) return std::fill(hits.begin(), hits.end(), Hit{});
        for (const ProbeLayer::Place& place : layer.places)
          hits[place.position] = traced()[place.pixel];
      }
    }
  }

 private:
  const Device& device() const { return shared_->gpu(); }
  const Pipelines& pipelines() const { return shared_->pipelines(); }

  Box world_region() const {
    return {flat_.region.lo + scene_.origin, flat_.region.hi + scene_.origin};
  }

  std::vector<PixelRect> tiles_of(const PixelRect& all) const {
    std::vector<PixelRect> tiles;
    const int side = int(shared_->tile_side());
    for (int y = all.y0; y < all.y1; y += side)
      for (int x = all.x0; x < all.x1; x += side)
        tiles.push_back({x, y, std::min(x + side, all.x1), std::min(y + side, all.y1)});
    return tiles;
  }

  Status make_buffer(Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                     Placement placement) {
    Result<Buffer> made = Buffer::make(device(), bytes, usage, placement);
    if (!made) return made.error();
    buffer = *std::move(made);
    return Done{};
  }

  /// Makes room in a buffer, half as much again as it has.
  Status reserve(Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage) {
    if (buffer.bytes() >= bytes) return Done{};
    return make_buffer(buffer, std::max(bytes, buffer.bytes() + buffer.bytes() / 2), usage,
                       Placement::kUpload);
  }

  VkBufferUsageFlags scene_usage() const {
    return shared_->storage() ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
                              : VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  }

  /// Makes a buffer of words and binds it for the shaders.
  Status send(const std::vector<uint32_t>& words, Binding binding, VkFormat format) {
    const VkPhysicalDeviceLimits& limits = device().limits();
    const VkDeviceSize texel = format == VK_FORMAT_R32_UINT ? 4 : 16;
    const VkDeviceSize bytes = room_for(words.size() * sizeof(uint32_t));
    const VkDeviceSize most = shared_->storage() ? VkDeviceSize(limits.maxStorageBufferRange)
                                                 : limits.maxTexelBufferElements * texel;
    if (bytes > most) {
      return Error{ErrorKind::kMachine,
                   device().info().name + ": the cells are too many for one of its buffers"};
    }
    SceneBuffer& to = scene_buffers_[binding];
    if (Status done = make_buffer(
            to.buffer, bytes, scene_usage() | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kDevice);
        !done)
      return done;
    if (Status done = gpu::upload(device(), commands_, to.buffer, std::as_bytes(std::span(words)));
        !done)
      return done;
    return bind_words(to, binding, format);
  }

  Status bind_words(SceneBuffer& to, uint32_t binding, VkFormat format) {
    if (shared_->storage()) {
      bind_buffer(binding, to.buffer);
      return Done{};
    }
    Result<Owned<VkBufferView>> view = gpu::make_texel_view(device(), to.buffer, format);
    if (!view) return view.error();
    to.view = *std::move(view);
    VkWriteDescriptorSet write = write_to(binding);
    write.pTexelBufferView = to.view.address();
    vkUpdateDescriptorSets(device().handle(), 1, &write, 0, nullptr);
    return Done{};
  }

  VkWriteDescriptorSet write_to(uint32_t binding) const {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = bindings_.set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = descriptor_type(binding, shared_->storage());
    return write;
  }

  void bind_buffer(uint32_t binding, const Buffer& buffer) const {
    const VkDescriptorBufferInfo info{buffer.handle(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write = write_to(binding);
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device().handle(), 1, &write, 0, nullptr);
  }

  /// Images and buffers for a tile of that size.
  Status make_tile(int width, int height) {
    if (width == tile_width_ && height == tile_height_) return Done{};
    tile_width_ = tile_height_ = 0;
    Result<Image> seen =
        Image::make(device(), kSeenFormat, side_for(width), side_for(height),
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    if (!seen) return seen.error();
    seen_ = *std::move(seen);
    Result<Image> depth =
        Image::make(device(), kDepthFormat, uint32_t(width), uint32_t(height),
                    VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    if (!depth) return depth.error();
    depth_ = *std::move(depth);
    const VkDeviceSize pixels = VkDeviceSize(width) * VkDeviceSize(height);
    if (Status done = make_buffer(hits_, pixels * sizeof(Hit), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                  Placement::kRead);
        !done)
      return done;
    if (Status done = make_buffer(positions_.buffer, room_for(pixels * sizeof(PixelPosition)),
                                  scene_usage(), Placement::kUpload);
        !done)
      return done;
    if (Status done = make_buffer(asked_, pixels * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  Placement::kUpload);
        !done)
      return done;
    if (Status done = bind_words(positions_, kPositionsBinding, VK_FORMAT_R32G32_SFLOAT); !done)
      return done;
    bind_buffer(kHitsBinding, hits_);
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, seen_.view(),
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write = write_to(kSeenBinding);
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device().handle(), 1, &write, 0, nullptr);
    tile_width_ = width;
    tile_height_ = height;
    return Done{};
  }

  const Hit* traced() const { return static_cast<const Hit*>(hits_.mapped()); }

  /// Facts for all pixels of a tile, or for the places of a layer; then they are in traced().
  Status trace_tile(const Camera& camera, const PixelRect& tile, const ProbeLayer* layer) {
    if (Status done = make_tile(tile.width(), tile.height()); !done) return done;
    // A place may be anywhere in its pixel.
    const double margin = shared_->margin(camera) + (layer ? 1 : 0);
    const ViewData view =
        make_view_data(scene_, camera, tile, shared_->doubles(), layer != nullptr, margin);
    std::memcpy(view_.mapped(), &view, sizeof(view));
    if (layer) {
      std::memcpy(positions_.buffer.mapped(), layer->positions.data(),
                  layer->positions.size() * sizeof(PixelPosition));
      std::memcpy(asked_.mapped(), layer->depth.data(), layer->depth.size() * sizeof(float));
    }
    const auto start = std::chrono::steady_clock::now();
    order_front_to_back(flat_, camera, local_eye(scene_, camera), tile, margin, visible_);
    if (Status done = make_instances(); !done) return done;
    stats_.order_ms += milliseconds_since(start);
    stats_.drawn += visible_.size();

    Result<VkCommandBuffer> recording = commands_.begin();
    if (!recording) return recording.error();
    commands_.stamp();
    draw(*recording, layer != nullptr);
    commands_.stamp();
    resolve(*recording);
    commands_.stamp();
    if (Status done = commands_.run(); !done) return done;
    const std::vector<double> times = commands_.intervals();
    if (times.size() == 2) {
      stats_.draw_ms += times[0];
      stats_.resolve_ms += times[1];
    }
    return Done{};
  }

  /// The visible cells as instances, the wide ones first.
  Status make_instances() {
    if (Status done = reserve(instances_, (visible_.size() + 1) * sizeof(Instance),
                              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        !done)
      return done;
    wide_ = uint32_t(std::ranges::count_if(visible_, &VisibleCell::is_wide));
    // Steps as large as they can be, powers of two: every depth is exact.
    const double step = 1 / double(std::bit_ceil(visible_.size() + 1));
    auto* const to = static_cast<Instance*>(instances_.mapped());
    uint32_t next_wide = 0, next_box = wide_;
    for (size_t rank = 0; rank < visible_.size(); ++rank) {
      const VisibleCell& v = visible_[rank];
      to[v.is_wide ? next_wide++ : next_box++] = {v.cell, float(double(rank + 1) * step)};
    }
    return Done{};
  }

  void draw(VkCommandBuffer commands, bool has_asked) const {
    constexpr VkPipelineStageFlags2 kTests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    const gpu::ImageUse unused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, 0};
    const gpu::ImageUse filled{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                               VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const gpu::ImageUse tested{VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kTests,
                               VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                                   VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    const VkExtent2D extent{uint32_t(tile_width_), uint32_t(tile_height_)};
    if (has_asked) {
      gpu::change_use(commands, depth_.handle(), depth_.aspect(), unused, filled);
      VkBufferImageCopy copy{};
      copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
      copy.imageExtent = {extent.width, extent.height, 1};
      vkCmdCopyBufferToImage(commands, asked_.handle(), depth_.handle(),
                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
      gpu::change_use(commands, depth_.handle(), depth_.aspect(), filled, tested);
    } else {
      gpu::change_use(commands, depth_.handle(), depth_.aspect(), unused, tested);
    }
    gpu::change_use(commands, seen_.handle(), seen_.aspect(), unused, drawn_use());

    VkRenderingAttachmentInfo color{};
    color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    color.imageView = seen_.view();
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = color;
    depth.imageView = depth_.view();
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = has_asked ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
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
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines().draw.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines().layout.get(), 0,
                            1, &bindings_.set, 0, nullptr);
    const VkBuffer instances = instances_.handle();
    const VkDeviceSize from_start = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &instances, &from_start);
    vkCmdBindIndexBuffer(commands, indices_.handle(), 0, VK_INDEX_TYPE_UINT16);
    const auto boxes = uint32_t(visible_.size()) - wide_;
    if (wide_ > 0) vkCmdDrawIndexed(commands, kSquareIndices, wide_, kBoxIndices, 0, 0);
    if (boxes > 0) vkCmdDrawIndexed(commands, kBoxIndices, boxes, 0, 0, wide_);
    vkCmdEndRendering(commands);
  }

  void resolve(VkCommandBuffer commands) const {
    const gpu::ImageUse read{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                             VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                             VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    gpu::change_use(commands, seen_.handle(), seen_.aspect(), drawn_use(), read);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines().resolve.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines().layout.get(), 0,
                            1, &bindings_.set, 0, nullptr);
    const auto groups = [](int pixels) { return (uint32_t(pixels) + kGroupSide - 1) / kGroupSide; };
    vkCmdDispatch(commands, groups(tile_width_), groups(tile_height_), 1);
    gpu::wait_for(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                  VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                  VK_ACCESS_2_HOST_READ_BIT);
  }

  static gpu::ImageUse drawn_use() {
    return {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
            VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
  }

  const Scene& scene_;
  std::shared_ptr<RasterDevice> shared_;  // outlives all that is made on it
  FlatCells flat_;
  uint32_t cell_count_ = 0;
  Commands commands_;
  Bindings bindings_;
  std::array<SceneBuffer, kBindings> scene_buffers_;
  Buffer view_, indices_, instances_, hits_, asked_;
  SceneBuffer positions_;
  Image seen_, depth_;
  int tile_width_ = 0, tile_height_ = 0;
  std::vector<VisibleCell> visible_;
  uint32_t wide_ = 0;
  RasterStats stats_;
  Status status_ = Done{};
};

}  // namespace

Result<std::shared_ptr<RasterDevice>> open_raster_device(const RasterSettings& settings) {
  return RasterDevice::open(settings);
}

std::string describe(const RasterDevice& device) {
  const gpu::DeviceInfo& info = device.gpu().info();
  return info.name + ", " + info.driver + (device.doubles() ? ", double" : ", float");
}

bool is_software(const RasterDevice& device) {
  return device.gpu().info().type == gpu::DeviceType::kSoftware;
}

std::vector<std::string> validation_messages(const RasterDevice& device) {
  return device.gpu().messages();
}

Result<std::unique_ptr<RasterTracer>> make_raster_tracer(std::shared_ptr<RasterDevice> device,
                                                         const Scene& scene,
                                                         const CellTree& cells) {
  auto tracer = std::make_unique<RasterTracerImpl>(scene, std::move(device));
  if (Status done = tracer->prepare(cells); !done) return done.error();
  return std::unique_ptr<RasterTracer>(std::move(tracer));
}

}  // namespace whittle

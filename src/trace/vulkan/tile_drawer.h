// Draws the cells of one tile of a picture, and finds the facts of its pixels.
#pragma once

#include <span>
#include <vector>

#include "gpu/commands.h"
#include "trace/vulkan/draw_list.h"
#include "trace/vulkan/probe_layers.h"
#include "trace/vulkan/view_data.h"

namespace whittle {

class TileDrawer {
 public:
  /// The arguments must outlive it; the scene is bound.
  static Result<TileDrawer> make(RasterDevice& device, gpu::Commands& commands,
                                 const Bindings& bindings);

  /// Of which the tiles and layers are that follow.
  void begin_picture() { ++picture_; }
  /// Facts for all pixels of a tile, or for the places of a layer; then they are in hits().
  /// `cells`: those that the tile may see, front to back; `cases`: of all cells, by number.
  Status draw(const ViewData& view, std::span<const VisibleCell> cells,
              std::span<const LeafCase> cases, const ProbeLayer* layer, RasterStats& stats);

  /// Row by row, or in the order of the layer's places; until the next draw().
  const Hit* hits() const { return static_cast<const Hit*>(hits_.mapped()); }

 private:
  /// Images and buffers for a tile of that size.
  Status resize(int width, int height);
  Status make_last_seen(size_t cells);
  void record_asked(VkCommandBuffer commands) const;
  void record_test(VkCommandBuffer commands, DrawList::Pass pass) const;
  void record_drawing(VkCommandBuffer commands, DrawList::Pass pass, bool has_asked) const;
  void record_resolving(VkCommandBuffer commands, const ProbeLayer* layer) const;

  const gpu::Device& gpu() const { return device_->gpu(); }
  Status make_buffer(gpu::Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                     gpu::Placement placement);

  RasterDevice* device_ = nullptr;
  gpu::Commands* commands_ = nullptr;
  const Bindings* bindings_ = nullptr;
  gpu::Buffer view_, indices_, hits_;
  gpu::Buffer last_seen_;  ///< by cell: the picture in which it was last seen
  uint32_t picture_ = 0;
  gpu::Buffer pyramid_;
  ReadBuffer positions_;  ///< where in the picture each pixel looks, if there is a layer
  gpu::Buffer places_;    ///< how many of them do, and which
  gpu::Buffer asked_;     ///< and depths that shut the pixels of which nothing is asked
  gpu::Image seen_, depth_;
  int width_ = 0, height_ = 0;
  DrawList list_;
};

}  // namespace whittle

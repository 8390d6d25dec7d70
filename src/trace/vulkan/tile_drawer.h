// Draws the cells of one tile of a picture, and finds the facts of its pixels.
#pragma once

#include <span>
#include <vector>

#include "gpu/commands.h"
#include "trace/vulkan/draw_list.h"
#include "trace/vulkan/probe_layers.h"
#include "trace/vulkan/view_data.h"

namespace whittle {

/// A part of the drawing of a tile. What a later part has lies behind what an earlier one has.
struct DrawPart {
  bool is_first = true, is_last = true;
  bool wants_hits = false;  ///< even if it is not the last
  bool is_dry = false;      ///< all is set up, nothing drawn
  uint32_t rank = 0;        ///< cells that the parts before had
};

class TileDrawer {
 public:
  /// The arguments must outlive it; the scene is bound.
  static Result<TileDrawer> make(RasterDevice& device, gpu::Commands& commands,
                                 const Bindings& bindings);

  /// Of which the tiles and layers are that follow.
  void begin_picture() { ++picture_; }
  /// Facts for all pixels of a tile, or for the places of a layer; then they are in hits().
  /// `cells`: those that the tile may see, front to back, of `cell_count` on the device.
  Status draw(const ViewData& view, std::span<const VisibleCell> cells, size_t cell_count,
              const ProbeLayer* layer, RasterStats& stats, const DrawPart& part = {});

  /// Row by row, or in the order of the layer's places; until the next draw().
  const Hit* hits() const { return static_cast<const Hit*>(hits_.mapped()); }
  /// After a part that is not the last: for each pixel 0 if it has not seen a cell yet.
  std::span<const uint32_t> seen() const {
    return {static_cast<const uint32_t*>(seen_copy_.mapped()), size_t(width_) * size_t(height_)};
  }

 private:
  /// Images and buffers for a tile of that size.
  Status resize(int width, int height);
  Status make_last_seen(size_t cells);
  void record_asked(VkCommandBuffer commands) const;
  void record_test(VkCommandBuffer commands, DrawList::Pass pass) const;
  /// `is_first`: nothing has been drawn. `has_depth`: or shut.
  void record_drawing(VkCommandBuffer commands, DrawList::Pass pass, bool is_first, bool has_depth);
  void record_copy_of_seen(VkCommandBuffer commands);
  void record_resolving(VkCommandBuffer commands, const ProbeLayer* layer);

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
  gpu::ImageUse seen_use_{};  ///< what the last commands did with it
  gpu::Buffer seen_copy_;     ///< made when it is first needed
  int width_ = 0, height_ = 0;
  DrawList list_;
};

}  // namespace whittle

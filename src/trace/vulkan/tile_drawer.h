// Draws the cells of one tile of a picture, and finds the facts of its pixels.
#pragma once

#include <span>
#include <vector>

#include "gpu/commands.h"
#include "trace/vulkan/bindings.h"
#include "trace/vulkan/front_to_back.h"
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

/// Ranks from front to back that a 32-bit float between 0 and 1 tells apart.
inline constexpr uint32_t kMostRanks = (1u << 24) - 1;

class TileDrawer {
 public:
  /// The arguments must outlive it; the scene is bound.
  static Result<TileDrawer> make(RasterDevice& device, gpu::Commands& commands,
                                 const Bindings& bindings);

  /// Facts for all pixels of a tile, or for the places of a layer; then they are in hits().
  /// `cells`: those that the tile may see, front to back. A kMachine error if they cannot be told
  /// apart by their ranks.
  Status draw(const ViewData& view, std::span<const VisibleCell> cells, const ProbeLayer* layer,
              RasterStats& stats, const DrawPart& part = {});

  /// Row by row, until the next draw().
  const Hit* hits() const { return static_cast<const Hit*>(hits_.mapped()); }
  /// After a part that is not the last: for each pixel 0 if it has not seen a cell yet.
  std::span<const uint32_t> seen() const {
    return {static_cast<const uint32_t*>(seen_copy_.mapped()), size_t(width_) * size_t(height_)};
  }

 private:
  /// Cells of one case, which are all drawn as boxes or all as squares.
  struct Draw {
    LeafCase shader = kAnyLeaf;
    bool is_wide = false;
    uint32_t first = 0, count = 0;  ///< instances
  };

  /// Images and buffers for a tile of that size.
  Status resize(int width, int height);
  Status make_instances(std::span<const VisibleCell> cells, uint32_t rank);
  void record_drawing(VkCommandBuffer commands, bool has_asked, const DrawPart& part);
  void record_resolving(VkCommandBuffer commands);
  void record_copy_of_seen(VkCommandBuffer commands);

  const gpu::Device& gpu() const { return device_->gpu(); }
  Status make_buffer(gpu::Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                     gpu::Placement placement);
  Status reserve(gpu::Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage);

  RasterDevice* device_ = nullptr;
  gpu::Commands* commands_ = nullptr;
  const Bindings* bindings_ = nullptr;
  gpu::Buffer view_, indices_, instances_, commands_of_draws_, hits_;
  ReadBuffer positions_;  ///< where in the picture each pixel looks, if there is a layer
  gpu::Buffer asked_;     ///< and depths that shut the pixels of which nothing is asked
  gpu::Image seen_, depth_;
  gpu::ImageUse seen_use_{};  ///< what the last commands did with it
  gpu::Buffer seen_copy_;     ///< made when it is first needed
  int width_ = 0, height_ = 0;
  std::vector<Draw> draws_;
};

}  // namespace whittle

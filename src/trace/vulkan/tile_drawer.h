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

class TileDrawer {
 public:
  /// The arguments must outlive it; the scene is bound.
  static Result<TileDrawer> make(RasterDevice& device, gpu::Commands& commands,
                                 const Bindings& bindings);

  /// Facts for all pixels of a tile, or for the places of a layer; then they are in hits().
  /// `cells`: those that the tile may see, front to back; `cases`: of all cells, by number.
  Status draw(const ViewData& view, std::span<const VisibleCell> cells,
              std::span<const LeafCase> cases, const ProbeLayer* layer, RasterStats& stats);

  /// Row by row, until the next draw().
  const Hit* hits() const { return static_cast<const Hit*>(hits_.mapped()); }

 private:
  /// Cells of one case, which are all drawn as boxes or all as squares.
  struct Draw {
    LeafCase shader = kAnyLeaf;
    bool is_wide = false;
    uint32_t first = 0, count = 0;  ///< instances
  };

  /// Images and buffers for a tile of that size.
  Status resize(int width, int height);
  Status make_instances(std::span<const VisibleCell> cells, std::span<const LeafCase> cases);
  void record_drawing(VkCommandBuffer commands, bool has_asked) const;
  void record_resolving(VkCommandBuffer commands) const;

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
  int width_ = 0, height_ = 0;
  std::vector<Draw> draws_;
};

}  // namespace whittle

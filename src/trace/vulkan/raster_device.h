// A device with all that vulkan-raster needs, whatever the scene. It serves many tracers, and
// compiles shaders once.
#pragma once

#include "base/box.h"
#include "trace/vulkan/pipelines.h"
#include "trace/vulkan/raster.h"

namespace whittle {

class RasterDevice {
 public:
  static Result<std::shared_ptr<RasterDevice>> open(const RasterSettings& settings);

  const gpu::Device& gpu() const { return *gpu_; }
  const Pipelines& pipelines() const { return pipelines_; }
  /// The leaves that the shader for such a leaf takes.
  LeafCase shader_for(LeafCase leaf) const { return specialised_ ? leaf : kAnyLeaf; }
  /// Compiles it, unless that is done.
  Status need(LeafCase shader);
  double first_batch_ms() const { return first_batch_ms_; }  ///< as in the settings
  bool culling() const { return culling_; }                  ///< cells behind others are left out
  bool doubles() const { return doubles_; }  ///< shaders compute in double precision
  bool storage() const { return storage_; }  ///< and read storage buffers, not texel buffers
  uint32_t tile_side() const { return tile_side_; }  ///< pixels that it draws at a time, at most
  /// Pixels that a box must be grown by on the screen, so that no rounding loses a pixel. `region`
  /// and `eye`: in local coordinates.
  double margin(const Camera& camera, const Box& region, Vec3 eye) const;

 private:
  /// Which of the shaders the device takes.
  Status choose(const RasterSettings& settings);

  std::unique_ptr<gpu::Device> gpu_;  // outlives the pipelines
  Pipelines pipelines_;
  double first_batch_ms_ = 0;
  bool doubles_ = false, storage_ = false, specialised_ = false, culling_ = true;
  uint32_t tile_side_ = 0;
};

}  // namespace whittle

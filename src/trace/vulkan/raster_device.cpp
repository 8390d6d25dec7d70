#include "trace/vulkan/raster_device.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "trace/vulkan/view_data.h"

namespace whittle {
namespace {

/// Pictures larger than this are made in tiles.
constexpr uint32_t kMostTileSide = 2048;

}  // namespace

Result<std::shared_ptr<RasterDevice>> RasterDevice::open(const RasterSettings& settings) {
  auto made = std::make_shared<RasterDevice>();
  Result<std::unique_ptr<gpu::Device>> device =
      gpu::Device::open({.wanted = settings.device, .validate = settings.validate});
  if (!device) return device.error();
  made->gpu_ = *std::move(device);
  if (Status chosen = made->choose(settings); !chosen) return chosen.error();
  Result<Pipelines> pipelines = make_pipelines(*made->gpu_, made->doubles_, made->storage_);
  if (!pipelines) return pipelines.error();
  made->pipelines_ = *std::move(pipelines);
  return made;
}

Status RasterDevice::choose(const RasterSettings& settings) {
  first_batch_ms_ = settings.first_batch_ms;
  const gpu::DeviceInfo& info = gpu_->info();
  const VkPhysicalDeviceLimits& limits = gpu_->limits();
  doubles_ = settings.numbers == ShaderNumbers::kAuto ? info.float64
                                                      : settings.numbers == ShaderNumbers::kDouble;
  if (doubles_ && !info.float64)
    return Error{ErrorKind::kMachine, info.name + " cannot compute in double precision"};
  culling_ = settings.culling;
  specialised_ = settings.shaders == ShaderCases::kSpecialised;
  // A software device that has room for many texels is Mesa's.
  constexpr uint32_t kManyTexels = 1u << 27;
  const bool texels_are_faster =
      info.type == gpu::DeviceType::kSoftware && limits.maxTexelBufferElements >= kManyTexels;
  storage_ = settings.reads == ShaderReads::kAuto ? !texels_are_faster
                                                  : settings.reads == ShaderReads::kStorage;
  uint64_t pixels = limits.maxStorageBufferRange / sizeof(Hit);
  if (!storage_) pixels = std::min<uint64_t>(pixels, limits.maxTexelBufferElements);
  tile_side_ =
      std::min({kMostTileSide, limits.maxImageDimension2D, limits.maxViewportDimensions[0],
                limits.maxFramebufferWidth, std::bit_floor(uint32_t(std::sqrt(double(pixels))))});
  return Done{};
}

Status RasterDevice::need(LeafCase shader) {
  return pipelines_.draw[shader] ? Status(Done{}) : add_draw(*gpu_, shader, pipelines_);
}

double RasterDevice::margin(const Camera& camera, const Box& region, Vec3 eye) const {
  // Two steps of the rasteriser's grid, and what rounding does to a corner before it gets there.
  double margin = 2 * std::ldexp(1.0, -int(gpu_->limits().subPixelPrecisionBits)) + 1.0 / 64;
  if (doubles_) return margin;
  // Floats place corners so badly, as a share of how far they are from their reference. No corner
  // is nearer to the eye than that.
  constexpr double kInFloats = 4e-6;
  const double ahead = reference_ahead(region, camera, eye);
  const Vec3 reference = eye + camera.forward * ahead;
  const double reach = length(max(abs(region.lo - reference), abs(region.hi - reference)));
  const double share = camera.orthographic ? reach : reach > 2 * ahead ? 2 : reach / ahead;
  return margin + kInFloats * share / camera.units_per_pixel();
}

}  // namespace whittle

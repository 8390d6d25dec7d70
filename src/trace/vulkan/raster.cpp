#include "trace/vulkan/raster.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "trace/vulkan/flatten.h"
#include "trace/vulkan/probe_layers.h"
#include "trace/vulkan/scene_data.h"
#include "trace/vulkan/tile_drawer.h"

namespace whittle {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// Supplies the drawer of tiles: with the scene, and with the cells in order.
class RasterTracerImpl final : public RasterTracer {
 public:
  RasterTracerImpl(const Scene& scene, std::shared_ptr<RasterDevice> device)
      : scene_(scene), device_(std::move(device)) {}

  Status prepare(const CellTree& tree) {
    Result<FlatCells> flat = flatten(scene_, tree, device_->doubles());
    if (!flat) return flat.error();
    flat_ = *std::move(flat);
    Result<gpu::Commands> commands = gpu::Commands::make(device_->gpu(), 3);
    if (!commands) return commands.error();
    commands_ = *std::move(commands);
    Result<Bindings> bindings = Bindings::make(*device_);
    if (!bindings) return bindings.error();
    bindings_ = *std::move(bindings);
    Result<SceneData> data = SceneData::make(*device_, commands_, bindings_, flat_);
    if (!data) return data.error();
    data_ = *std::move(data);
    // The device has them now.
    cell_count_ = flat_.cell_count();
    flat_.half_spaces = {};
    flat_.cells = {};
    flat_.words = {};
    Result<TileDrawer> drawer = TileDrawer::make(*device_, commands_, bindings_);
    if (!drawer) return drawer.error();
    drawer_ = *std::move(drawer);
    return Done{};
  }

  const char* name() const override { return "vulkan-raster"; }
  Status status() const override { return status_; }
  RasterStats stats() const override { return stats_; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame(camera.width, camera.height);
    stats_ = {};
    stats_.cells = cell_count_;
    drawer_.begin_picture();
    if (flat_.root == kNoChild) return frame;
    const std::vector<PixelRect> tiles = tiles_of(pixels_covering(camera, world_region()));
    for (size_t i = 0; i < tiles.size() && status_; ++i) {
      const PixelRect& tile = tiles[i];
      status_ = trace_tile(camera, tile, nullptr, stats_);
      if (!status_) break;
      for (int y = 0; y < tile.height(); ++y)
        std::memcpy(&frame.at(tile.x0, tile.y0 + y),
                    drawer_.hits() + size_t(y) * size_t(tile.width()),
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
        RasterStats unused;
        status_ = trace_tile(camera, tile, &layer, unused);
        if (!status_) return std::fill(hits.begin(), hits.end(), Hit{});
        for (size_t i = 0; i < layer.places.size(); ++i)
          hits[layer.places[i].position] = drawer_.hits()[i];
      }
    }
  }

 private:
  Box world_region() const {
    return {flat_.region.lo + scene_.origin, flat_.region.hi + scene_.origin};
  }

  std::vector<PixelRect> tiles_of(const PixelRect& all) const {
    std::vector<PixelRect> tiles;
    const int side = int(device_->tile_side());
    for (int y = all.y0; y < all.y1; y += side)
      for (int x = all.x0; x < all.x1; x += side)
        tiles.push_back({x, y, std::min(x + side, all.x1), std::min(y + side, all.y1)});
    return tiles;
  }

  Status trace_tile(const Camera& camera, const PixelRect& tile, const ProbeLayer* layer,
                    RasterStats& stats) {
    // A place may be anywhere in its pixel.
    const double margin = device_->margin(camera) + (layer ? 1 : 0);
    const auto start = std::chrono::steady_clock::now();
    order_front_to_back(flat_, camera, local_eye(scene_, camera), tile, margin, visible_);
    stats.order_ms += milliseconds_since(start);
    const ViewData view =
        make_view_data(scene_, camera, tile, device_->doubles(), layer != nullptr, margin);
    return drawer_.draw(view, visible_, flat_.cases, layer, stats);
  }

  const Scene& scene_;
  std::shared_ptr<RasterDevice> device_;  // outlives all that is made on it
  FlatCells flat_;
  uint32_t cell_count_ = 0;
  gpu::Commands commands_;
  Bindings bindings_;
  SceneData data_;
  TileDrawer drawer_;
  std::vector<VisibleCell> visible_;
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

#include "trace/vulkan/raster.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "base/timing.h"
#include "subdivide/subdivide.h"
#include "trace/vulkan/cell_stream.h"
#include "trace/vulkan/cell_supply.h"
#include "trace/vulkan/probe_layers.h"
#include "trace/vulkan/scene_data.h"
#include "trace/vulkan/tile_drawer.h"

namespace whittle {
namespace {

/// What shaders/resolve.comp writes where it is in doubt.
bool is_doubtful(const Hit& hit) {
  return hit.id == shader::kDoubtfulId;
}

/// Brings together the supply of cells, their place on the device, and the drawer of tiles.
class RasterTracerImpl final : public RasterTracer {
 public:
  RasterTracerImpl(const Scene& scene, const CellTree& tree, std::shared_ptr<RasterDevice> device,
                   const MakeTracer& second_look, int threads)
      : scene_(scene),
        cell_margin_(tree.margin),
        device_(std::move(device)),
        second_look_(second_look),
        supply_(scene, tree, device_->doubles(), threads) {}

  Status prepare() {
    Result<gpu::Commands> commands = gpu::Commands::make(device_->gpu(), 3);
    if (!commands) return commands.error();
    commands_ = *std::move(commands);
    Result<Bindings> bindings = Bindings::make(*device_);
    if (!bindings) return bindings.error();
    bindings_ = *std::move(bindings);
    Result<SceneData> data = SceneData::make(*device_, commands_, bindings_,
                                             flatten_half_spaces(scene_, device_->doubles()));
    if (!data) return data.error();
    data_ = *std::move(data);
    Result<TileDrawer> drawer = TileDrawer::make(*device_, commands_, bindings_);
    if (!drawer) return drawer.error();
    drawer_ = *std::move(drawer);
    if (supply_.is_open()) return Done{};
    return send(supply_.at_once(nullptr));
  }

  const char* name() const override { return "vulkan-raster"; }
  Status status() const override { return status_; }
  RasterStats stats() const override { return stats_; }

  Frame render(const Camera& camera, const RenderControl& control) override {
    Frame frame(camera.width, camera.height);
    stats_ = {};
    clock_ = {};
    drawer_.begin_picture();
    supply_.follow();
    if (supply_.flat().root == kNoChild) return frame;
    const std::vector<PixelRect> tiles = tiles_of(pixels_covering(camera, world_region()));
    for (size_t i = 0; i < tiles.size() && status_ && !control.stop.stop_requested(); ++i) {
      const PixelRect& tile = tiles[i];
      const auto show = [&] {
        copy_hits(tile, frame);
        look_again(camera, tile, frame);
        control.part_seen(frame, tile);
      };
      status_ = trace_tile(camera, tile, nullptr, stats_,
                           control.part_seen ? std::function<void()>(show) : nullptr);
      if (!status_) break;
      copy_hits(tile, frame);
      const Stopwatch again;
      stats_.in_doubt += look_again(camera, tile, frame);
      stats_.second_ms += again.milliseconds();
      if (control.part_seen) control.part_seen(frame, tile);
      if (control.progress) control.progress(double(i + 1) / double(tiles.size()));
    }
    stats_.cells = supply_.cell_count();
    if (!status_) return Frame(camera.width, camera.height);
    return frame;
  }

  void set_up(const Camera& camera) override {
    supply_.follow();
    for (const PixelRect& tile : tiles_of(pixels_covering(camera, world_region()))) {
      if (!status_) return;
      RasterStats unused;
      status_ = trace_tile(camera, tile, nullptr, unused, nullptr, {.is_dry = true});
    }
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    std::fill(hits.begin(), hits.end(), Hit{});
    supply_.follow();
    if (supply_.flat().root == kNoChild || positions.empty()) return;
    for (const PixelRect& tile : tiles_of(pixels_of(positions))) {
      for (const ProbeLayer& layer : probe_layers(positions, tile)) {
        if (!status_) return;
        RasterStats unused;
        status_ = trace_tile(camera, tile, &layer, unused, nullptr);
        if (!status_) return std::fill(hits.begin(), hits.end(), Hit{});
        for (size_t i = 0; i < layer.places.size(); ++i)
          hits[layer.places[i].position] = drawer_.hits()[i];
      }
    }
    doubtful_.clear();
    for (size_t i = 0; i < hits.size(); ++i)
      if (is_doubtful(hits[i])) doubtful_.push_back({positions[i], &hits[i]});
    settle(camera);
  }

  void cast(std::span<const Ray> rays, std::span<Hit> hits) override { second().cast(rays, hits); }
  void cast_through(std::span<const Ray> rays, RayCrossings& found) override {
    second().cast_through(rays, found);
  }

 private:
  Tracer& second() {
    if (!second_) second_ = second_look_();
    return *second_;
  }

  Box world_region() const {
    return {supply_.region().lo + scene_.origin, supply_.region().hi + scene_.origin};
  }

  std::vector<PixelRect> tiles_of(const PixelRect& all) const {
    std::vector<PixelRect> tiles;
    const int side = int(device_->tile_side());
    for (int y = all.y0; y < all.y1; y += side)
      for (int x = all.x0; x < all.x1; x += side)
        tiles.push_back({x, y, std::min(x + side, all.x1), std::min(y + side, all.y1)});
    return tiles;
  }

  void copy_hits(const PixelRect& tile, Frame& frame) const {
    for (int y = 0; y < tile.height(); ++y)
      std::memcpy(&frame.at(tile.x0, tile.y0 + y),
                  drawer_.hits() + size_t(y) * size_t(tile.width()),
                  size_t(tile.width()) * sizeof(Hit));
  }

  /// Asks the other tracer where the shaders were in doubt; says at how many pixels.
  size_t look_again(const Camera& camera, const PixelRect& tile, Frame& frame) {
    doubtful_.clear();
    if (device_->doubles()) return 0;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        if (Hit& hit = frame.at(x, y); is_doubtful(hit))
          doubtful_.push_back({{float(x) + 0.5f, float(y) + 0.5f}, &hit});
    settle(camera);
    return doubtful_.size();
  }

  void settle(const Camera& camera) {
    if (doubtful_.empty()) return;
    std::vector<PixelPosition> positions;
    for (const Doubtful& place : doubtful_) positions.push_back(place.position);
    std::vector<Hit> hits(positions.size());
    second().probe(camera, positions, hits);
    for (size_t i = 0; i < hits.size(); ++i) *doubtful_[i].hit = hits[i];
  }

  Status send(const Result<CellBatch>& batch) {
    return batch ? data_.append(batch->cells, batch->words) : batch.error();
  }

  /// `show`, if any, is called when some of the tile's pixels are known: others are background yet.
  Status trace_tile(const Camera& camera, const PixelRect& tile, const ProbeLayer* layer,
                    RasterStats& stats, const std::function<void()>& show,
                    const DrawPart& part = {}) {
    // A place may be anywhere in its pixel.
    const Vec3 eye = local_eye(scene_, camera);
    const double margin = device_->margin(camera, supply_.region(), eye) + (layer ? 1 : 0);
    const Sight sight(camera, eye, scene_.origin, tile, margin);
    const ViewData view = make_view_data(scene_, cell_margin_, camera, tile, device_->doubles(),
                                         layer != nullptr, margin);
    if (supply_.is_open()) {
      if (!layer) return draw_stream(sight, view, show);
      if (Status done = send(supply_.at_once(&sight)); !done) return done;
    }
    const Stopwatch watch;
    order_front_to_back(supply_.flat(), supply_.region(), sight, visible_, open_);
    if (!open_.empty()) {
      if (Status done = send(supply_.refined(open_, sight, visible_)); !done) return done;
    }
    stats.order_ms += watch.milliseconds();
    return drawer_.draw(view, visible_, supply_.cell_count(), layer, stats, part);
  }

  /// The first picture: cells are refined while others are drawn.
  Status draw_stream(const Sight& sight, const ViewData& view, const std::function<void()>& show) {
    size_t sent = supply_.cell_count();  // not to be asked while the stream runs
    CellStream stream(supply_, sight, device_->first_batch_ms());
    DrawPart part{.is_first = true, .is_last = false, .wants_hits = bool(show)};
    while (!part.is_last) {
      // What it throws leaves cells behind that never come.
      status_ = Error{ErrorKind::kMachine, "the cells were not refined"};
      const Result<CellBatch> batch = stream.next();
      status_ = Done{};
      if (Status done = send(batch); !done) return done;
      part.is_last = batch->is_last;
      sent += batch->cells.size() / shader::kCellWords;
      if (Status done = drawer_.draw(view, batch->visible, sent, nullptr, stats_, part); !done)
        return done;
      if (part.is_first) stats_.first_ms = clock_.milliseconds();
      ++stats_.batches;
      part.rank += uint32_t(batch->visible.size());
      part.is_first = false;
      if (part.is_last) break;
      if (show) show();
      stream.hide(std::make_shared<const SolvedPixels>(drawer_.seen(), view.tile_size[0],
                                                       view.tile_size[1]));
    }
    return Done{};
  }

  /// A place of which the shaders cannot say what is seen there, and where the answer goes.
  struct Doubtful {
    PixelPosition position;
    Hit* hit;
  };

  const Scene& scene_;
  const double cell_margin_;
  std::shared_ptr<RasterDevice> device_;  // outlives all that is made on it
  const MakeTracer second_look_;
  std::unique_ptr<Tracer> second_;  ///< made when it is first needed
  std::vector<Doubtful> doubtful_;
  CellSupply supply_;
  gpu::Commands commands_;
  Bindings bindings_;
  SceneData data_;
  TileDrawer drawer_;
  std::vector<VisibleCell> visible_;
  std::vector<OpenCellInSight> open_;
  Stopwatch clock_;
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

double cell_margin(const RasterDevice& device) {
  // Twice what shaders/ray_float.glsl needs four edges of the region from its reference, and half
  // of the smallest cells.
  return device.doubles() ? kCellMargin : std::ldexp(1.0, -15);
}

std::vector<std::string> validation_messages(const RasterDevice& device) {
  return device.gpu().messages();
}

Result<std::unique_ptr<RasterTracer>> make_raster_tracer(std::shared_ptr<RasterDevice> device,
                                                         const Scene& scene, const CellTree& cells,
                                                         const MakeTracer& second_look,
                                                         int threads) {
  auto tracer =
      std::make_unique<RasterTracerImpl>(scene, cells, std::move(device), second_look, threads);
  if (Status done = tracer->prepare(); !done) return done.error();
  return std::unique_ptr<RasterTracer>(std::move(tracer));
}

}  // namespace whittle

#include "trace/cpu/cpu.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/result.h"
#include "base/workers.h"
#include "trace/cpu/lanes.h"
#include "trace/pixel_rect.h"

namespace whittle {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 16;  ///< pixels; a tile's rays walk together
constexpr int kBlock = 32;                        ///< pixels a task; small enough to balance
constexpr size_t kProbeChunk = 1024;              ///< positions a task
constexpr size_t kProbeRays = 64;  ///< that walk together wherever they are, and more if they are
constexpr float kProbePixels = 8;  ///< all within so many pixels, both ways
static_assert(kTileWidth * kTileHeight == kTileRays);

/// Every other bit of `i`: a number along the Z-order curve is x in the even bits, y in the odd.
constexpr uint32_t even_bits(size_t i) {
  uint32_t result = 0;
  for (int bit = 0; bit < 8; ++bit) result |= uint32_t(i >> (2 * bit) & 1) << bit;
  return result;
}

/// The pixels of a tile in Z order, so that those of a packet, or of a part of the tile, are a
/// compact patch.
struct TileOrder {
  std::array<uint32_t, kTileRays> x, y;
  std::array<PixelPosition, kTileRays> middle;
  constexpr TileOrder() : x(), y(), middle() {
    for (size_t i = 0; i < kTileRays; ++i) {
      x[i] = even_bits(i);
      y[i] = even_bits(i >> 1);
      middle[i] = {float(x[i]) + 0.5f, float(y[i]) + 0.5f};
    }
  }
};
constexpr TileOrder kTileOrder;

class CpuTracerImpl final : public CpuTracer {
 public:
  CpuTracerImpl(const Scene& scene, const CellTree& tree, int threads)
      : workers_(threads), lanes_(scene, tree, &workers_), scratches_(workers_) {}

  const char* name() const override { return "cpu"; }

  Frame render(const Camera& camera, const RenderControl& control) override {
    return frame_of(camera, control, [&](const TileRays& rays, size_t, LaneScratch& scratch) {
      trace_lanes(lanes_, camera, rays.positions(), rays.places.data(), rays.hits, scratch);
    });
  }

  Frame record(const Camera& camera) override {
    records_.clear();
    records_.resize(size_t(parts(camera.width, kTileWidth)) *
                    size_t(parts(camera.height, kTileHeight)));
    return frame_of(camera, {}, [&](const TileRays& rays, size_t tile, LaneScratch& scratch) {
      trace_lanes(lanes_, camera, rays.positions(), rays.places.data(), rays.hits, scratch,
                  &records_[tile]);
    });
  }

  Frame replay(const Camera& camera) override {
    return frame_of(camera, {}, [&](const TileRays& rays, size_t tile, LaneScratch& scratch) {
      retrace_lanes(lanes_, camera, rays.positions(), rays.places.data(), rays.hits, scratch,
                    records_[tile]);
    });
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    if (lanes_.tree.region.is_empty()) {
      std::fill(hits.begin(), hits.end(), Hit{});
      return;
    }
    workers_.for_parts(
        positions.size(), kProbeChunk, [&](size_t first, size_t last, size_t worker) {
          LaneScratch& scratch = scratches_.of(worker, lanes_);
          for (size_t i = first; i < last;) {
            const auto left = positions.subspan(i, last - i);
            const size_t count = close_together(left);
            trace_lanes(lanes_, camera, left.first(count), kInOrder.data(), &hits[i], scratch);
            i += count;
          }
        });
  }

  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    if (lanes_.tree.region.is_empty()) {
      std::fill(hits.begin(), hits.end(), Hit{});
      return;
    }
    workers_.for_parts(rays.size(), kProbeChunk, [&](size_t first, size_t last, size_t worker) {
      LaneScratch& scratch = scratches_.of(worker, lanes_);
      for (size_t i = first; i < last; i += kProbeRays)
        trace_lanes(lanes_, rays.subspan(i, std::min(kProbeRays, last - i)), &hits[i], scratch);
    });
  }

  void cast_through(std::span<const Ray> rays, RayCrossings& found) override {
    found = {};
    if (lanes_.tree.region.is_empty()) {
      found.ends.assign(rays.size(), 0);
      return;
    }
    std::vector<RayCrossings> of_part(rays.size() / kProbeChunk + 1);
    workers_.for_parts(of_part.size(), 1, [&](size_t first, size_t last, size_t worker) {
      LaneScratch& scratch = scratches_.of(worker, lanes_);
      for (size_t part = first; part < last; ++part) {
        const size_t end = std::min((part + 1) * kProbeChunk, rays.size());
        for (size_t i = part * kProbeChunk; i < end; i += kProbeRays) {
          cross_lanes(lanes_, rays.subspan(i, std::min(kProbeRays, end - i)), of_part[part],
                      scratch);
        }
      }
    });
    for (const RayCrossings& part : of_part) {
      for (const size_t end : part.ends) found.ends.push_back(found.all.size() + end);
      found.all.insert(found.all.end(), part.all.begin(), part.all.end());
    }
  }

  TraceStats stats() const override {
    TraceStats sum;
    scratches_.for_each([&](const LaneScratch& scratch) {
      sum.rays += scratch.stats.rays;
      sum.cells += scratch.stats.cells;
      sum.leaves += scratch.stats.leaves;
      sum.literals += scratch.stats.literals;
      sum.disagreements += scratch.stats.disagreements + scratch.solver.disagreements;
    });
    return sum;
  }

 private:
  /// The rays of a tile's pixels, and where their hits go.
  struct TileRays {
    size_t count = kTileRays;
    std::array<PixelPosition, kTileRays> position;
    std::array<uint32_t, kTileRays> places;
    Hit* hits;

    TileRays(const PixelRect& tile, Frame& frame) : hits(&frame.at(tile.x0, tile.y0)) {
      for (size_t i = 0; i < kTileRays; ++i) {
        position[i] = {kTileOrder.middle[i].x + float(tile.x0),
                       kTileOrder.middle[i].y + float(tile.y0)};
        places[i] = kTileOrder.y[i] * uint32_t(frame.width) + kTileOrder.x[i];
      }
      if (tile.width() == kTileWidth && tile.height() == kTileHeight) return;
      count = 0;
      for (size_t i = 0; i < kTileRays; ++i) {
        position[count] = position[i], places[count] = places[i];
        count +=
            size_t(int(kTileOrder.x[i]) < tile.width() && int(kTileOrder.y[i]) < tile.height());
      }
    }
    std::span<const PixelPosition> positions() const { return std::span(position).first(count); }
  };

  /// How many of the positions, from the first on, had better walk together; no more than a tile.
  static size_t close_together(std::span<const PixelPosition> positions) {
    const size_t most = std::min(kTileRays, positions.size());
    PixelPosition low = positions[0], high = low;
    for (size_t i = 1; i < most; ++i) {
      const PixelPosition p = positions[i];
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      const bool is_close = high.x - low.x <= kProbePixels && high.y - low.y <= kProbePixels;
      // Packets are full, but for the last.
      if (i >= kProbeRays && !is_close) return i - i % kMaxLanes;
    }
    return most;
  }

  static int parts(int pixels, int of) { return (pixels + of - 1) / of; }

  /// Calls trace(rays, tile's number, scratch) for all tiles in which something may be seen.
  template <class Trace>
  Frame frame_of(const Camera& camera, const RenderControl& control, const Trace& trace) {
    Frame frame = Frame::unfilled(camera.width, camera.height);
    const PixelRect seen =
        lanes_.tree.region.is_empty() ? PixelRect{} : pixels_covering(camera, world_region());
    const int columns = parts(camera.width, kBlock), rows = parts(camera.height, kBlock);
    const int tile_columns = parts(camera.width, kTileWidth);
    const auto trace_block = [&](const PixelRect& block, LaneScratch& scratch) {
      for (int y = block.y0; y < block.y1; y += kTileHeight)
        for (int x = block.x0; x < block.x1; x += kTileWidth) {
          const PixelRect tile{x, y, std::min(x + kTileWidth, block.x1),
                               std::min(y + kTileHeight, block.y1)};
          if (tile.x0 < seen.x1 && tile.x1 > seen.x0 && tile.y0 < seen.y1 && tile.y1 > seen.y0)
            trace(TileRays(tile, frame), size_t(y / kTileHeight * tile_columns + x / kTileWidth),
                  scratch);
          else
            leave_empty(tile, frame, scratch);
        }
    };
    std::atomic<int> done = 0;
    workers_.for_parts(size_t(columns) * size_t(rows), 1,
                       [&](size_t first, size_t last, size_t worker) {
                         LaneScratch& scratch = scratches_.of(worker, lanes_);
                         for (int i = int(first); i < int(last); ++i) {
                           if (control.stop.stop_requested()) return;
                           const int x = i % columns * kBlock, y = i / columns * kBlock;
                           const PixelRect block{x, y, std::min(x + kBlock, camera.width),
                                                 std::min(y + kBlock, camera.height)};
                           trace_block(block, scratch);
                           if (control.part_seen) control.part_seen(frame, block);
                           const int now = ++done;
                           if (control.progress && now % columns == 0)
                             control.progress(double(now) / (columns * rows));
                         }
                       });
    return frame;
  }

  static void leave_empty(const PixelRect& tile, Frame& frame, LaneScratch& scratch) {
    for (int y = tile.y0; y < tile.y1; ++y) std::fill_n(&frame.at(tile.x0, y), tile.width(), Hit{});
    scratch.stats.rays += uint64_t(tile.width()) * uint64_t(tile.height());
  }

  Box world_region() const {
    const Box& region = lanes_.tree.region;
    return {region.lo + lanes_.scene.origin, region.hi + lanes_.scene.origin};
  }

  Workers workers_;
  const LaneScene lanes_;
  PerWorker<LaneScratch> scratches_;
  std::vector<TileRecord> records_;  ///< by tile, of the picture that was recorded
};

}  // namespace

std::unique_ptr<CpuTracer> make_cpu_tracer(const Scene& scene, const CellTree& cells, int threads) {
  return std::make_unique<CpuTracerImpl>(scene, cells, threads);
}

}  // namespace whittle

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

constexpr int kTileWidth = 8, kTileHeight = 8;  ///< pixels; a tile's rays walk together
constexpr int kBlock = 32;                      ///< pixels a task; small enough to balance
constexpr size_t kProbeChunk = 256;             ///< positions a task
static_assert(kTileWidth * kTileHeight == kTileRays);

/// Every other bit of `i`: a number along the Z-order curve is x in the even bits, y in the odd.
constexpr uint32_t even_bits(size_t i) {
  uint32_t result = 0;
  for (int bit = 0; bit < 8; ++bit) result |= uint32_t(i >> (2 * bit) & 1) << bit;
  return result;
}

/// The pixels of a tile in Z order, so that 2, 4 or 8 in a row are a compact patch.
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

/// One after the other.
struct InOrder {
  std::array<uint32_t, kTileRays> place;
  constexpr InOrder() : place() {
    for (uint32_t i = 0; i < kTileRays; ++i) place[i] = i;
  }
};
constexpr InOrder kInOrder;

class CpuTracerImpl final : public CpuTracer {
 public:
  CpuTracerImpl(const Scene& scene, const CellTree& tree, int threads)
      : scene_(scene), tree_(tree), lanes_(scene, tree), workers_(threads), scratches_(workers_) {}

  const char* name() const override { return "cpu"; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame = Frame::unfilled(camera.width, camera.height);
    const PixelRect seen =
        tree_.region.is_empty() ? PixelRect{} : pixels_covering(camera, world_region());
    const int columns = (camera.width + kBlock - 1) / kBlock,
              rows = (camera.height + kBlock - 1) / kBlock;
    std::atomic<int> done = 0;
    workers_.for_parts(size_t(columns) * size_t(rows), 1,
                       [&](size_t first, size_t last, size_t worker) {
                         LaneScratch& scratch = scratches_.of(worker, lanes_);
                         for (int block = int(first); block < int(last); ++block) {
                           trace_block(camera, block % columns * kBlock, block / columns * kBlock,
                                       seen, frame, scratch);
                           const int now = ++done;
                           if (progress && now % columns == 0)
                             progress(double(now) / (columns * rows));
                         }
                       });
    return frame;
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    if (tree_.region.is_empty()) {
      std::fill(hits.begin(), hits.end(), Hit{});
      return;
    }
    workers_.for_parts(
        positions.size(), kProbeChunk, [&](size_t first, size_t last, size_t worker) {
          LaneScratch& scratch = scratches_.of(worker, lanes_);
          for (size_t i = first; i < last; i += kTileRays)
            trace_lanes(lanes_, camera, positions.subspan(i, std::min(kTileRays, last - i)),
                        kInOrder.place.data(), &hits[i], scratch);
        });
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
  void trace_block(const Camera& camera, int x0, int y0, const PixelRect& seen, Frame& frame,
                   LaneScratch& scratch) {
    const int x1 = std::min(x0 + kBlock, camera.width), y1 = std::min(y0 + kBlock, camera.height);
    for (int y = y0; y < y1; y += kTileHeight)
      for (int x = x0; x < x1; x += kTileWidth) {
        const PixelRect tile{x, y, std::min(x + kTileWidth, x1), std::min(y + kTileHeight, y1)};
        if (tile.x0 < seen.x1 && tile.x1 > seen.x0 && tile.y0 < seen.y1 && tile.y1 > seen.y0)
          trace_tile(camera, tile, frame, scratch);
        else
          leave_empty(tile, frame, scratch);
      }
  }

  void trace_tile(const Camera& camera, const PixelRect& tile, Frame& frame, LaneScratch& scratch) {
    std::array<PixelPosition, kTileRays> positions;
    std::array<uint32_t, kTileRays> places;
    for (size_t i = 0; i < kTileRays; ++i) {
      positions[i] = {kTileOrder.middle[i].x + float(tile.x0),
                      kTileOrder.middle[i].y + float(tile.y0)};
      places[i] = uint32_t(kTileOrder.y[i]) * uint32_t(frame.width) + kTileOrder.x[i];
    }
    size_t n = kTileRays;
    if (tile.width() < kTileWidth || tile.height() < kTileHeight) {
      n = 0;
      for (size_t i = 0; i < kTileRays; ++i) {
        positions[n] = positions[i], places[n] = places[i];
        n += size_t(int(kTileOrder.x[i]) < tile.width() && int(kTileOrder.y[i]) < tile.height());
      }
    }
    trace_lanes(lanes_, camera, std::span(positions).first(n), places.data(),
                &frame.at(tile.x0, tile.y0), scratch);
  }

  static void leave_empty(const PixelRect& tile, Frame& frame, LaneScratch& scratch) {
    for (int y = tile.y0; y < tile.y1; ++y) std::fill_n(&frame.at(tile.x0, y), tile.width(), Hit{});
    scratch.stats.rays += uint64_t(tile.width()) * uint64_t(tile.height());
  }

  Box world_region() const {
    return {tree_.region.lo + scene_.origin, tree_.region.hi + scene_.origin};
  }

  const Scene& scene_;
  const CellTree& tree_;
  const LaneScene lanes_;
  Workers workers_;
  PerWorker<LaneScratch> scratches_;
};

}  // namespace

std::unique_ptr<CpuTracer> make_cpu_tracer(const Scene& scene, const CellTree& cells, int threads) {
  return std::make_unique<CpuTracerImpl>(scene, cells, threads);
}

}  // namespace whittle

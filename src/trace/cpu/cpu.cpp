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

constexpr int kTile = 16;  ///< pixels; small enough to balance, large enough to cost nothing
constexpr size_t kProbeChunk = 256;  ///< positions a task
constexpr uint32_t kMaxDepth = 192;  ///< what the walk through the cells has room for

/// Every other bit of `i`: a number along the Z-order curve is x in the even bits, y in the odd.
constexpr int even_bits(int i) {
  int result = 0;
  for (int bit = 0; bit < 8; ++bit) result |= (i >> (2 * bit) & 1) << bit;
  return result;
}

/// The pixels of a tile in Z order, so that 2, 4, 8 or 16 in a row are a compact patch.
struct TileOrder {
  std::array<uint8_t, size_t(kTile) * kTile> x, y;
  constexpr TileOrder() : x(), y() {
    for (int i = 0; i < kTile * kTile; ++i) {
      x[size_t(i)] = uint8_t(even_bits(i));
      y[size_t(i)] = uint8_t(even_bits(i >> 1));
    }
  }
};
constexpr TileOrder kTileOrder;

class CpuTracerImpl final : public CpuTracer {
 public:
  CpuTracerImpl(const Scene& scene, const CellTree& tree, int threads)
      : scene_(scene), tree_(tree), lanes_(scene, tree), workers_(threads), scratches_(workers_) {
    WHITTLE_CHECK(tree.stats.depth < kMaxDepth);
  }

  const char* name() const override { return "cpu"; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame(camera.width, camera.height);
    if (tree_.region.is_empty()) return frame;
    const PixelRect rect = pixels_covering(camera, world_region());
    rays_beside_ += uint64_t(camera.width) * uint64_t(camera.height) -
                    uint64_t(rect.width()) * uint64_t(rect.height());
    const int columns = (rect.width() + kTile - 1) / kTile,
              rows = (rect.height() + kTile - 1) / kTile;
    std::atomic<int> done = 0;
    workers_.for_parts(size_t(columns) * size_t(rows), 1,
                       [&](size_t first, size_t last, size_t worker) {
                         LaneScratch& scratch = scratches_.of(worker, lanes_);
                         for (int tile = int(first); tile < int(last); ++tile) {
                           trace_tile(camera, rect.x0 + tile % columns * kTile,
                                      rect.y0 + tile / columns * kTile, rect, frame, scratch);
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
          trace_lanes(lanes_, camera, positions.subspan(first, last - first),
                      hits.subspan(first, last - first), scratches_.of(worker, lanes_));
        });
  }

  TraceStats stats() const override {
    TraceStats sum;
    sum.rays = rays_beside_;
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
  void trace_tile(const Camera& camera, int x0, int y0, const PixelRect& rect, Frame& frame,
                  LaneScratch& scratch) {
    std::array<PixelPosition, size_t(kTile) * kTile> positions;
    std::array<Hit, size_t(kTile) * kTile> hits;
    size_t n = 0;
    const auto in_tile = [&](size_t i, int& x, int& y) {
      x = x0 + kTileOrder.x[i], y = y0 + kTileOrder.y[i];
      return x < rect.x1 && y < rect.y1;
    };
    int x, y;
    for (size_t i = 0; i < positions.size(); ++i)
      if (in_tile(i, x, y)) positions[n++] = {float(x) + 0.5f, float(y) + 0.5f};
    trace_lanes(lanes_, camera, std::span(positions).first(n), std::span(hits).first(n), scratch);
    n = 0;
    for (size_t i = 0; i < positions.size(); ++i)
      if (in_tile(i, x, y)) frame.at(x, y) = hits[n++];
  }

  Box world_region() const {
    return {tree_.region.lo + scene_.origin, tree_.region.hi + scene_.origin};
  }

  const Scene& scene_;
  const CellTree& tree_;
  const LaneScene lanes_;
  uint64_t rays_beside_ = 0;  ///< rays of pixels that cannot see the region
  Workers workers_;
  PerWorker<LaneScratch> scratches_;
};

}  // namespace

std::unique_ptr<CpuTracer> make_cpu_tracer(const Scene& scene, const CellTree& cells, int threads) {
  return std::make_unique<CpuTracerImpl>(scene, cells, threads);
}

}  // namespace whittle

#include "trace/cpu/cpu.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/result.h"
#include "base/workers.h"
#include "trace/cpu/solve.h"
#include "trace/pixel_rect.h"

namespace whittle {
namespace {

constexpr int kTile = 16;  ///< pixels; small enough to balance, large enough to cost nothing
constexpr size_t kProbeChunk = 256;  ///< positions a task
constexpr uint32_t kMaxDepth = 192;  ///< three axes, each halved at most 64 times

/// One thread's view of the work.
class RayWalker {
 public:
  RayWalker(const Scene& scene, const CellTree& tree)
      : scene_(scene), tree_(tree), solver_(scene, tree) {}

  TraceStats stats;
  uint64_t solver_disagreements() const { return solver_.disagreements; }

  Hit trace(const Ray& world_ray) {
    ++stats.rays;
    // Start next to the solid's middle: far eyes would eat the digits.
    const Vec3 from = world_ray.origin - scene_.origin;
    const double shift = -dot(from, world_ray.direction);
    const Vec3 d = world_ray.direction;
    const LocalRay ray{from + d * shift, d};
    const Vec3 inverse{1 / d.x, 1 / d.y, 1 / d.z};

    Interval span{world_ray.t_min - shift, kInfinity};
    for (int axis = 0; axis < 3; ++axis)
      if (!clip(ray, inverse[axis], axis, span)) return {};
    // Outside the region of a bounded solid there is nothing; a ray that starts inside of it, or
    // an unbounded solid, tells only at its first cell.
    const bool starts_outside = span.t0 > world_ray.t_min - shift;
    Inside inside = starts_outside && scene_.bounded ? Inside::kNo : Inside::kUnknown;
    Change change;
    if (!walk(ray, inverse, span, inside, change)) return {};
    return {float(change.t + shift),
            change.id,
            {float(change.normal.x), float(change.normal.y), float(change.normal.z)}};
  }

 private:
  struct Interval {
    double t0, t1;
  };
  struct Later {
    uint32_t cell;
    Interval span;
  };

  bool clip(const LocalRay& ray, double inverse, int axis, Interval& span) const {
    const double lo = tree_.region.lo[axis], hi = tree_.region.hi[axis], o = ray.origin[axis];
    if (ray.direction[axis] == 0) return lo <= o && o <= hi;
    const double a = (lo - o) * inverse, b = (hi - o) * inverse;
    span.t0 = std::max(span.t0, std::min(a, b));
    span.t1 = std::min(span.t1, std::max(a, b));
    return span.t0 <= span.t1;
  }

  /// Front to back through the cells; neighbours share the split's exact t.
  bool walk(const LocalRay& ray, Vec3 inverse, Interval span, Inside inside, Change& change) {
    Later later[kMaxDepth];
    uint32_t waiting = 0;
    uint32_t at = 0;
    while (true) {
      const Cell& cell = tree_.cells[at];
      ++stats.cells;
      if (cell.kind == CellKind::kNode) {
        const double o = ray.origin[cell.axis], d = ray.direction[cell.axis];
        // A ray along the split stays on its side of it.
        const double t = d == 0 ? kInfinity : (cell.split - o) * inverse[cell.axis];
        const uint32_t near_side = d == 0 ? o > cell.split : d < 0;
        if (t >= span.t1) {
          at = cell.index + near_side;
        } else if (t <= span.t0) {
          at = cell.index + 1 - near_side;
        } else {
          later[waiting++] = {cell.index + 1 - near_side, {t, span.t1}};
          at = cell.index + near_side;
          span.t1 = t;
        }
        continue;
      }
      if (leaf(cell, ray, span, inside, change)) return true;
      if (waiting == 0) return false;
      --waiting;
      at = later[waiting].cell;
      span = later[waiting].span;
    }
  }

  bool leaf(const Cell& cell, const LocalRay& ray, Interval span, Inside& inside, Change& change) {
    if (cell.kind == CellKind::kIgnored) {
      inside = Inside::kUnknown;
      return false;
    }
    if (cell.kind == CellKind::kEmpty || cell.kind == CellKind::kFull) {
      const Inside here = cell.kind == CellKind::kFull ? Inside::kYes : Inside::kNo;
      // A surface on a cell's side is a literal on both sides of it, so this cannot be a change.
      if (inside != Inside::kUnknown && inside != here) ++stats.disagreements;
      inside = here;
      return false;
    }
    const Leaf& leaf = tree_.leaves[cell.index];
    ++stats.leaves;
    stats.literals += leaf.literal_count;
    return solver_.first_change(cell.kind, leaf, ray, span.t0, span.t1, inside, change);
  }

  const Scene& scene_;
  const CellTree& tree_;
  LeafSolver solver_;
};

class CpuTracerImpl final : public CpuTracer {
 public:
  CpuTracerImpl(const Scene& scene, const CellTree& tree, int threads)
      : scene_(scene),
        tree_(tree),
        workers_(threads),
        walkers_([&scene, &tree] { return RayWalker(scene, tree); }) {
    WHITTLE_CHECK(tree.stats.depth < kMaxDepth);
  }

  const char* name() const override { return "cpu"; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame(camera.width, camera.height);
    if (tree_.region.is_empty()) return frame;
    const PixelRect rect = pixels_covering(camera, world_region());
    rays_beside_ += uint64_t(camera.width) * camera.height - uint64_t(rect.width()) * rect.height();
    const int columns = (rect.width() + kTile - 1) / kTile,
              rows = (rect.height() + kTile - 1) / kTile;
    std::atomic<int> done = 0;
    workers_.run([&] {
      tbb::parallel_for(0, columns * rows, [&](int tile) {
        RayWalker& walker = walkers_.local();
        const int x0 = rect.x0 + tile % columns * kTile, y0 = rect.y0 + tile / columns * kTile;
        const int x1 = std::min(x0 + kTile, rect.x1), y1 = std::min(y0 + kTile, rect.y1);
        for (int y = y0; y < y1; ++y)
          for (int x = x0; x < x1; ++x) frame.at(x, y) = walker.trace(camera.ray(x + 0.5, y + 0.5));
        const int now = ++done;
        if (progress && now % columns == 0) progress(double(now) / (columns * rows));
      });
    });
    return frame;
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    if (tree_.region.is_empty()) {
      std::fill(hits.begin(), hits.end(), Hit{});
      return;
    }
    workers_.run([&] {
      tbb::parallel_for(tbb::blocked_range<size_t>(0, positions.size(), kProbeChunk),
                        [&](const auto& range) {
                          RayWalker& walker = walkers_.local();
                          for (size_t i = range.begin(); i < range.end(); ++i)
                            hits[i] = walker.trace(camera.ray(positions[i].x, positions[i].y));
                        });
    });
  }

  TraceStats stats() const override {
    TraceStats sum;
    sum.rays = rays_beside_;
    for (const RayWalker& walker : walkers_) {
      sum.rays += walker.stats.rays;
      sum.cells += walker.stats.cells;
      sum.leaves += walker.stats.leaves;
      sum.literals += walker.stats.literals;
      sum.disagreements += walker.stats.disagreements + walker.solver_disagreements();
    }
    return sum;
  }

 private:
  Box world_region() const {
    return {tree_.region.lo + scene_.origin, tree_.region.hi + scene_.origin};
  }

  const Scene& scene_;
  const CellTree& tree_;
  uint64_t rays_beside_ = 0;  ///< rays of pixels that cannot see the region
  Workers workers_;
  tbb::enumerable_thread_specific<RayWalker> walkers_;
};

}  // namespace

std::unique_ptr<CpuTracer> make_cpu_tracer(const Scene& scene, const CellTree& cells, int threads) {
  return std::make_unique<CpuTracerImpl>(scene, cells, threads);
}

}  // namespace whittle

#include "trace/oracle/oracle.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/workers.h"
#include "model/instances.h"
#include "trace/oracle/boolean_tree.h"
#include "trace/oracle/crossings.h"
#include "trace/oracle/span.h"

namespace whittle {

namespace {

/// What one thread needs for its rays.
struct Scratch {
  explicit Scratch(const BooleanTree& tree) : state(tree) {}
  BooleanState state;
  std::vector<Crossing> crossings;
  std::vector<size_t> group_ends;
};

class OracleTracer final : public Tracer {
 public:
  OracleTracer(const Model& model, int threads)
      : instances_(instances(model)),
        tree_(make_boolean_tree(model)),
        bounds_(bounds(model)),
        coincidence_(bounds_),
        workers_(threads) {
    for (uint32_t leaf = 0; leaf < instances_.size(); ++leaf) {
      ids_.push_back(model.primitives[instances_[leaf].primitive].id);
      if (instances_[leaf].empty) continue;
      solids_.push_back(make_convex_solid(model, instances_[leaf]));
      leaves_.push_back(leaf);
    }
  }

  const char* name() const override { return "oracle"; }

  Frame render(const Camera& camera, const Progress& progress) override {
    Frame frame(camera.width, camera.height);
    for_ranges(size_t(camera.height), progress, [&](size_t y, Scratch& scratch) {
      for (int x = 0; x < camera.width; ++x)
        frame.at(x, int(y)) = trace(camera.ray(x + 0.5, double(y) + 0.5), scratch);
    });
    return frame;
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for_ranges(positions.size(), {}, [&](size_t i, Scratch& scratch) {
      hits[i] = trace(camera.ray(double(positions[i].x), double(positions[i].y)), scratch);
    });
  }

 private:
  template <class Work>
  void for_ranges(size_t count, const Progress& progress, const Work& work) {
    PerWorker<Scratch> scratches(workers_);
    std::atomic<size_t> done = 0;
    workers_.for_parts(count, 1, [&](size_t first, size_t last, size_t worker) {
      Scratch& scratch = scratches.of(worker, tree_);
      for (size_t i = first; i < last; ++i) work(i, scratch);
      const size_t so_far = done += last - first;
      if (progress) progress(double(so_far) / double(count));
    });
  }

  Hit trace(const Ray& ray, Scratch& scratch) const {
    double start = ray.t_min, end = kInfinity;
    if (!bounds_.bounded) {
      const Span region = ray_span(view_region(bounds_), ray.origin, ray.direction);
      if (region.is_empty()) return {};
      start = std::max(start, region.t0);
      end = region.t1;
    }

    BooleanState& state = scratch.state;
    std::vector<Crossing>& crossings = scratch.crossings;
    crossings.clear();
    for (size_t i = 0; i < solids_.size(); ++i) {
      const Span span = ray_span(solids_[i], ray.origin, ray.direction);
      if (span.is_empty()) continue;
      if (std::isfinite(span.t0))
        crossings.push_back({span.t0, leaves_[i], true, span.n0});
      else
        state.flip(leaves_[i]);
      if (std::isfinite(span.t1)) crossings.push_back({span.t1, leaves_[i], false, span.n1});
    }
    group_crossings(crossings, ray.direction, coincidence_, scratch.group_ends);

    Hit hit;
    size_t begin = 0;
    for (const size_t group_end : scratch.group_ends) {
      const double t = crossings[begin].t;
      if (t > end) break;
      state.begin_step();
      for (size_t i = begin; i < group_end; ++i) state.flip(crossings[i].leaf);
      if (state.has_changed() && t > start) {
        const uint32_t owner = state.owner();
        // A leaf that changed has one crossing here; with both it would be as it was.
        const auto crossing = std::find_if(crossings.begin() + std::ptrdiff_t(begin),
                                           crossings.begin() + std::ptrdiff_t(group_end),
                                           [&](const Crossing& c) { return c.leaf == owner; });
        const Vec3 n = state.value() == crossing->enters ? crossing->normal : -crossing->normal;
        hit = {float(crossing->t), ids_[owner], {float(n.x), float(n.y), float(n.z)}};
        break;
      }
      begin = group_end;
    }
    for (const uint32_t leaf : leaves_)
      if (state.is_inside(leaf)) state.flip(leaf);
    return hit;
  }

  std::vector<Instance> instances_;
  BooleanTree tree_;
  Bounds bounds_;
  Coincidence coincidence_;
  Workers workers_;
  std::vector<uint32_t> ids_;        ///< of the instances
  std::vector<ConvexSolid> solids_;  ///< those instances that are not empty
  std::vector<uint32_t> leaves_;     ///< their indices among the instances
};

}  // namespace

std::unique_ptr<Tracer> make_oracle_tracer(const Model& model, int threads) {
  return std::make_unique<OracleTracer>(model, threads);
}

}  // namespace whittle

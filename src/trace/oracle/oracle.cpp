#include "trace/oracle/oracle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include "base/workers.h"
#include "model/instances.h"
#include "trace/oracle/boolean_tree.h"
#include "trace/oracle/mesh_crossings.h"
#include "trace/oracle/span.h"

namespace whittle {

namespace {

/// A ray's crossing of one primitive's surface.
struct Crossing {
  double t = 0;
  uint32_t leaf = 0;    ///< the primitive, as an index into instances()
  bool enters = false;  ///< the primitive, not the solid
  Vec3 normal;          ///< unit outward normal of the primitive, world space
};

/// What one thread needs for its rays.
struct Scratch {
  explicit Scratch(const BooleanTree& tree) : state(tree) {}
  BooleanState state;
  std::vector<Crossing> crossings;
  std::vector<MeshCrossing> of_mesh;
};

class OracleTracer final : public Tracer {
 public:
  OracleTracer(const Model& model, int threads)
      : instances_(instances(model)),
        tree_(make_boolean_tree(model)),
        bounds_(bounds(model)),
        ray_tolerance_(ray_tolerance(view_region(bounds_))),
        surfaces_(name_surfaces(model, instances_)),
        workers_(threads) {
    for (uint32_t leaf = 0; leaf < instances_.size(); ++leaf) {
      ids_.push_back(model.primitives[instances_[leaf].primitive].id);
      if (instances_[leaf].empty) continue;
      leaves_.push_back(leaf);
      const TriangleMesh* mesh = boundary(model.primitives[instances_[leaf].primitive].shape);
      meshes_.push_back(mesh ? world_mesh(*mesh, instances_[leaf].world_from_object) : WorldMesh{});
    }
  }

  const char* name() const override { return "oracle"; }

  Frame render(const Camera& camera, const RenderControl& control) override {
    Frame frame(camera.width, camera.height);
    for_ranges(size_t(camera.height), control.progress, [&](size_t row, Scratch& scratch) {
      const int y = int(row);
      for (int x = 0; x < camera.width; ++x) {
        if (control.stop.stop_requested()) return;
        frame.at(x, y) = trace(camera.ray(x + 0.5, y + 0.5), scratch);
      }
      if (control.part_seen) control.part_seen(frame, {0, y, camera.width, y + 1});
    });
    return frame;
  }

  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for_ranges(positions.size(), {}, [&](size_t i, Scratch& scratch) {
      hits[i] = trace(camera.ray(double(positions[i].x), double(positions[i].y)), scratch);
    });
  }

  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    for_ranges(rays.size(), {},
               [&](size_t i, Scratch& scratch) { hits[i] = trace(rays[i], scratch); });
  }

  void cast_through(std::span<const Ray> rays, RayCrossings& found) override {
    std::vector<std::vector<SurfaceCrossing>> of_ray(rays.size());
    for_ranges(rays.size(), {}, [&](size_t i, Scratch& scratch) {
      walk(rays[i], scratch, [&](const SurfaceCrossing& crossing) {
        of_ray[i].push_back(crossing);
        return true;
      });
    });
    found = {};
    for (const std::vector<SurfaceCrossing>& crossings : of_ray) {
      found.all.insert(found.all.end(), crossings.begin(), crossings.end());
      found.ends.push_back(found.all.size());
    }
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
    Hit hit;
    walk(ray, scratch, [&](const SurfaceCrossing& c) {
      hit = {float(c.distance), c.id, {float(c.normal.x), float(c.normal.y), float(c.normal.z)}};
      return false;
    });
    return hit;
  }

  /// Calls `visit` for what the ray crosses, one after the other, as long as it returns true.
  template <class Visit>
  void walk(const Ray& ray, Scratch& scratch, const Visit& visit) const {
    double start = ray.t_min, end = kInfinity;
    if (!bounds_.bounded) {
      const Span region = ray_span(view_region(bounds_), ray.origin, ray.direction);
      if (region.is_empty()) return;
      start = std::max(start, region.t0);
      end = region.t1;
    }

    // An eye on a surface has passed it (docs/conventions.md); rounding may put it a little before,
    // across the surface, which along a flat ray is farther.
    const auto is_passed = [&](const Crossing& c) {
      return c.t <= start ||
             (c.t - start <= 1e6 * ray_tolerance_ &&
              (c.t - start) * std::fabs(dot(c.normal, ray.direction)) <= 10 * ray_tolerance_);
    };

    BooleanState& state = scratch.state;
    std::vector<Crossing>& crossings = scratch.crossings;
    crossings.clear();
    for (size_t i = 0; i < surfaces_.solid_count(); ++i) {
      if (!meshes_[i].triangles.empty()) {
        scratch.of_mesh.clear();
        mesh_crossings(surfaces_, i, meshes_[i], ray.origin, ray.direction, scratch.of_mesh);
        for (const MeshCrossing& c : scratch.of_mesh)
          crossings.push_back({c.t, leaves_[i], c.enters, c.normal});
        continue;
      }
      const Span span = ray_span(surfaces_, i, ray.origin, ray.direction);
      if (span.is_empty()) continue;
      if (std::isfinite(span.t0))
        crossings.push_back({span.t0, leaves_[i], true, span.n0});
      else
        state.flip(leaves_[i]);
      if (std::isfinite(span.t1)) crossings.push_back({span.t1, leaves_[i], false, span.n1});
    }
    std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::tuple(c.t, c.leaf); });

    for (size_t begin = 0; begin < crossings.size();) {
      // Surfaces that are one are crossed at one t; others may be but for rounding, which grows
      // with the eye's distance.
      const double t = crossings[begin].t;
      const double last = t + ray_tolerance_ + 1e-15 * std::fabs(t);
      if (t > end) break;
      state.begin_step();
      size_t group_end = begin;
      do state.flip(crossings[group_end].leaf);
      while (++group_end < crossings.size() && crossings[group_end].t <= last);
      if (state.has_changed() && !is_passed(crossings[begin])) {
        const uint32_t owner = state.owner();
        // A leaf that changed has one crossing here, or is a mesh and the first tells.
        const auto crossing = std::find_if(crossings.begin() + std::ptrdiff_t(begin),
                                           crossings.begin() + std::ptrdiff_t(group_end),
                                           [&](const Crossing& c) { return c.leaf == owner; });
        const Vec3 n = state.value() == crossing->enters ? crossing->normal : -crossing->normal;
        if (!visit(SurfaceCrossing{t, ids_[owner], state.value(), n})) break;
      }
      begin = group_end;
    }
    for (const uint32_t leaf : leaves_)
      if (state.is_inside(leaf)) state.flip(leaf);
  }

  std::vector<Instance> instances_;
  BooleanTree tree_;
  Bounds bounds_;
  double ray_tolerance_;
  Surfaces surfaces_;  ///< of those instances that are not empty
  Workers workers_;
  std::vector<uint32_t> ids_;      ///< of the instances
  std::vector<WorldMesh> meshes_;  ///< one a solid; without triangles if it is none
  std::vector<uint32_t> leaves_;   ///< the indices of the solids among the instances
};

}  // namespace

std::unique_ptr<Tracer> make_oracle_tracer(const Model& model, int threads) {
  return std::make_unique<OracleTracer>(model, threads);
}

}  // namespace whittle

#include "whittle/reading.h"

#include <cstddef>
#include <memory>

#include "base/workers.h"
#include "boundary/closed_mesh.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "subdivide/solid_bounds.h"

namespace whittle {

Box tight_box(const Model& model) {
  const Bounds around = bounds(model);
  if (!around.bounded || around.box.is_empty()) return around.box;
  const Result<Scene> scene = lower(model);
  return seen_box(model, scene ? solid_bounds(*scene, 0).box : around.box);
}

std::function<Result<TriangleMesh>(const Model&)> mesh_maker(int threads) {
  return [threads, workers = std::shared_ptr<const Workers>()](const Model& model) mutable {
    // A boundary that takes more takes minutes, or gigabytes.
    constexpr BoundaryLimits kLimits{
        .cell_memory = size_t(1) << 28, .pairs = 1'000'000'000, .pieces = 1'000'000};
    if (!workers) workers = std::make_shared<const Workers>(threads);
    return closed_mesh(model, *workers, kLimits);
  };
}

}  // namespace whittle

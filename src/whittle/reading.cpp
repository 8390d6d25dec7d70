#include "whittle/reading.h"

#include <cstddef>
#include <memory>
#include <optional>

#include "base/workers.h"
#include "boundary/closed_mesh.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "subdivide/solid_bounds.h"

namespace whittle {

Box tight_box(const Model& model, int threads) {
  const Bounds around = bounds(model);
  if (!around.bounded || around.box.is_empty()) return around.box;
  // A smaller model is lowered before threads have started.
  constexpr size_t kManyNodes = size_t(1) << 14;
  std::optional<Workers> workers;
  if (model.nodes.size() >= kManyNodes) workers.emplace(threads);
  const Result<Scene> scene = lower(model, workers ? &*workers : nullptr);
  return seen_box(model, scene ? solid_bounds(*scene, threads).box : around.box);
}

std::function<Box(const Model&)> box_maker(int threads) {
  return [threads](const Model& model) { return tight_box(model, threads); };
}

std::vector<SourceLocation> statement_places(const Model& model) {
  std::vector<SourceLocation> places(size_t(model.statement_count) + 1);
  for (const Node& node : model.nodes) {
    // A body stands before its parts, and it is the statement.
    if (node.kind != NodeKind::kPrimitive && node.kind != NodeKind::kBody) continue;
    const uint32_t id =
        node.kind == NodeKind::kBody ? node.payload : model.primitives[node.payload].id;
    if (places[id] == SourceLocation{}) places[id] = node.where;
  }
  return places;
}

std::function<Result<TriangleMesh>(const Model&, size_t& pieces)> mesh_maker(int threads) {
  return [threads, workers = std::shared_ptr<const Workers>()](const Model& model,
                                                               size_t& pieces) mutable {
    // A boundary that takes more takes minutes, or gigabytes.
    BoundarySettings settings;
    settings.cell_memory = size_t(1) << 28;
    settings.pairs = 1'000'000'000;
    settings.pieces = 1'000'000;
    if (!workers) workers = std::make_shared<const Workers>(threads);
    BoundaryStats stats;
    Result<TriangleMesh> mesh = closed_mesh(model, *workers, settings, &stats);
    pieces = stats.pieces;
    return mesh;
  };
}

}  // namespace whittle

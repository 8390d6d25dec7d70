#include "subdivide/subdivide.h"

#include <algorithm>

#include "base/workers.h"
#include "subdivide/refine.h"

namespace whittle {
namespace {

/// Cells with longer formulas are refined side by side before anybody asks: whoever looks at the
/// tree meets them first, and all threads would wait for one.
constexpr uint32_t kLongFormula = 256;

/// As many open cells as this keep all threads busy.
constexpr size_t kEnough = 256;

/// Refines all open cells of which `wanted` holds, level by level, until enough are left or none.
template <class Wanted>
std::vector<const Cell*> widen(const CellTree& tree, const Workers& workers,
                               PerWorker<RefinerLease>& refiners, Wanted&& wanted) {
  // What is very long, many threads split together.
  const Helpers helpers{workers,
                        [&](size_t worker) -> Refiner& { return *refiners.of(worker, tree); }};
  RefinerLease(tree)->refined(*tree.root, &helpers);
  std::vector<const Cell*> level{tree.root};
  while (!level.empty() && level.size() < kEnough) {
    std::vector<CellLink> links(level.size());
    workers.for_parts(level.size(), 1, [&](size_t first, size_t last, size_t worker) {
      RefinerLease& refiner = refiners.of(worker, tree);
      for (size_t i = first; i < last; ++i) links[i] = refiner->refined(*level[i]);
    });
    level.clear();
    for (const CellLink link : links) {
      if (link.kind() != CellKind::kNode) continue;
      for (const Cell* child : {link.children(), link.children() + 1})
        if (wanted(child->link())) level.push_back(child);
    }
  }
  return level;
}

}  // namespace

CellTree open_cells(const Scene& scene, const SubdivideSettings& settings, const Workers* workers) {
  CellTree tree;
  tree.region = scene.region;
  tree.margin = settings.margin * max_component(scene.region.size());
  tree.refiner_pool = std::make_shared<RefinerPool>(scene, settings, workers);
  tree.root = &tree.refiner_pool->root();
  return tree;
}

void refine_top(const CellTree& tree, const Workers& workers) {
  const auto is_long = [](CellLink link) {
    return link.kind() == CellKind::kOpen &&
           static_cast<const OpenCell*>(link.target())->token_count > kLongFormula;
  };
  if (!is_long(tree.root->link())) return;
  PerWorker<RefinerLease> refiners(workers);
  widen(tree, workers, refiners, is_long);
}

void refine_levels(const CellTree& tree, const Workers& workers) {
  PerWorker<RefinerLease> refiners(workers);
  widen(tree, workers, refiners, [](CellLink) { return true; });
}

void refine_all(const CellTree& tree, const Workers& workers) {
  PerWorker<RefinerLease> refiners(workers);
  const auto any = [](CellLink) { return true; };
  const std::vector<const Cell*> open = widen(tree, workers, refiners, any);
  workers.for_parts(open.size(), 1, [&](size_t first, size_t last, size_t worker) {
    RefinerLease& refiner = refiners.of(worker, tree);
    for (size_t i = first; i < last; ++i) refiner->refine_all(*open[i]);
  });
}

CellTree subdivide(const Scene& scene, const SubdivideSettings& settings) {
  const Workers workers(settings.threads);
  CellTree tree = open_cells(scene, settings, &workers);
  refine_all(tree, workers);
  return tree;
}

}  // namespace whittle

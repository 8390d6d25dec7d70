#include "subdivide/refine.h"

namespace whittle {

RefinerPool::RefinerPool(const Scene& scene, const SubdivideSettings& settings,
                         const Workers* workers)
    : scene_(scene),
      settings_(settings),
      boxes_(scene, workers),
      root_{{}, {kNowhere, kNowhere}, 0} {
  Refiner& refiner = take();
  const CellLink whole = refiner.open_region();
  root().bits.store(whole.bits(), std::memory_order_relaxed);
  ++refiner.store_.stats.cells[size_t(whole.kind())];
  refiner.store_.stats.memory_bytes += sizeof(Cell);
  give(refiner);
}

Refiner& RefinerPool::take() {
  const std::lock_guard lock(mutex_);
  if (unused_.empty()) {
    all_.push_back(std::make_unique<Refiner>(scene_, boxes_, settings_));
    unused_.reserve(all_.size());
    return *all_.back();
  }
  Refiner& refiner = *unused_.back();
  unused_.pop_back();
  return refiner;
}

void RefinerPool::give(Refiner& refiner) {
  const std::lock_guard lock(mutex_);
  unused_.push_back(&refiner);
}

SubdivideStats RefinerPool::stats() const {
  SubdivideStats sum;
  for (const auto& refiner : all_) {
    const SubdivideStats& part = refiner->store_.stats;
    for (size_t kind = 0; kind < sum.cells.size(); ++kind) sum.cells[kind] += part.cells[kind];
    if (sum.leaves_by_size.size() < part.leaves_by_size.size())
      sum.leaves_by_size.resize(part.leaves_by_size.size());
    for (size_t size = 0; size < part.leaves_by_size.size(); ++size)
      sum.leaves_by_size[size] += part.leaves_by_size[size];
    sum.depth = std::max(sum.depth, part.depth);
    sum.classified += part.classified;
    sum.refined += part.refined;
    sum.memory_bytes += part.memory_bytes;
  }
  return sum;
}

}  // namespace whittle

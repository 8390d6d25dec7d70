#include "subdivide/cells.h"

#include <numeric>

#include "subdivide/refine.h"

namespace whittle {

uint64_t SubdivideStats::cell_count() const {
  return std::accumulate(cells.begin(), cells.end(), uint64_t(0));
}

uint64_t SubdivideStats::leaf_count() const {
  return std::accumulate(leaves_by_size.begin(), leaves_by_size.end(), uint64_t(0));
}

SubdivideStats statistics_of(const CellTree& tree) {
  return tree.refiner_pool ? tree.refiner_pool->stats() : SubdivideStats{};
}

}  // namespace whittle

#include "subdivide/join_grid.h"

#include <array>
#include <utility>

namespace whittle {

CellLink join_grid(const SplitGrid& grid, std::vector<CellLink> links, CellStore& store,
                   double& split) {
  std::vector<double> splits(links.size(), 0);
  std::array<size_t, 3> count{grid.cuts[0].size() - 1, grid.cuts[1].size() - 1,
                              grid.cuts[2].size() - 1};
  std::array<size_t, 3> stride{1, 1, 1};  // of the finest parts
  // The last splits are the first to be joined.
  for (size_t level = grid.axes.size(); level-- > 0;) {
    const int axis = grid.axes[level];
    const size_t along = size_t(axis);
    std::array<size_t, 3> half = count;
    half[along] /= 2;
    std::vector<CellLink> joined(half[0] * half[1] * half[2]);
    std::vector<double> joined_splits(joined.size());
    for (size_t z = 0; z < half[2]; ++z)
      for (size_t y = 0; y < half[1]; ++y)
        for (size_t x = 0; x < half[0]; ++x) {
          const std::array<size_t, 3> to{x, y, z};
          std::array<size_t, 3> low = to;
          low[along] *= 2;
          std::array<size_t, 3> high = low;
          ++high[along];
          const auto number = [&](const std::array<size_t, 3>& at) {
            return (at[2] * count[1] + at[1]) * count[0] + at[0];
          };
          const size_t a = number(low), b = number(high), at = (z * half[1] + y) * half[0] + x;
          if (links[a].bits() == links[b].bits()) {
            joined[at] = links[a];
            continue;
          }
          Cell* const pair = store.new_pair();
          for (const auto& [made, from] : {std::pair(pair, a), std::pair(pair + 1, b)}) {
            made->split = splits[from];
            made->bits.store(links[from].bits(), std::memory_order_relaxed);
            ++store.stats.cells[size_t(links[from].kind())];
          }
          joined[at] = CellLink(CellKind::kNode, pair, axis);
          joined_splits[at] = grid.cuts[along][high[along] * stride[along]];
        }
    links = std::move(joined);
    splits = std::move(joined_splits);
    count = half;
    stride[along] *= 2;
  }
  split = splits[0];
  return links[0];
}

}  // namespace whittle

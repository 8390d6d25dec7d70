#include "subdivide/cell_store.h"

#include <memory>
#include <new>

namespace whittle {

Cell* CellStore::new_pair() {
  const size_t bytes = has_threshold_ ? sizeof(CellPair) : 2 * sizeof(Cell);
  auto* const pair = static_cast<Cell*>(cells_.allocate(bytes, alignof(CellPair)));
  for (Cell* const cell : {pair, pair + 1}) {
    ::new (cell) Cell;
    if (has_threshold_) across(*cell) = kNowhere;
  }
  if (has_threshold_) pair_of(*pair).changed = 0;
  stats.memory_bytes += bytes;
  return pair;
}

CellLink CellStore::open(const OpenCell& what, std::span<const Token> formula,
                         std::span<const uint32_t> near) {
  const size_t bytes = OpenCell::bytes(formula.size() + near.size());
  auto* const made = ::new (open_cells_.take(bytes)) OpenCell(what);
  made->token_count = uint32_t(formula.size());
  std::uninitialized_copy(formula.begin(), formula.end(), reinterpret_cast<Token*>(made + 1));
  made->near_count = uint32_t(near.size());
  std::uninitialized_copy(near.begin(), near.end(), const_cast<uint32_t*>(made->near().data()));
  stats.memory_bytes += bytes;
  return {CellKind::kOpen, made};
}

void CellStore::give_back(const OpenCell& open) {
  const size_t bytes = OpenCell::bytes(open.words());
  stats.memory_bytes -= bytes;
  open_cells_.give(const_cast<OpenCell*>(&open), bytes);
}

CellLink CellStore::leaf(LeafAnalysis& analysis) {
  const CellLink link = analysis.write(leaves_);
  const Leaf& leaf = link.leaf();
  stats.memory_bytes += leaf.bytes();
  if (stats.leaves_by_size.size() <= leaf.literal_count)
    stats.leaves_by_size.resize(leaf.literal_count + 1);
  ++stats.leaves_by_size[leaf.literal_count];
  return link;
}

}  // namespace whittle

// Where the cells that one thread makes are kept, and how many there are.
#pragma once

#include <span>

#include "base/arena.h"
#include "subdivide/leaf.h"
#include "subdivide/open_cell.h"

namespace whittle {

/// What it hands out never moves and lives as long as the store, open cells until they are given
/// back.
class CellStore {
 public:
  /// `has_threshold`: pairs know what their cells would be across it.
  explicit CellStore(bool has_threshold) : has_threshold_(has_threshold) {}

  /// Two cells in a row, empty ones.
  Cell* new_pair();
  /// A cell of its own with that formula, and with those triangles near.
  CellLink open(const OpenCell& what, std::span<const Token> formula,
                std::span<const uint32_t> near);
  /// Of this store, or of any that lives as long.
  void give_back(const OpenCell& open);
  /// Precondition: the formula that was analysed is not constant.
  CellLink leaf(LeafAnalysis& analysis);

  static CellLink decided(bool full) {
    return {full ? CellKind::kFull : CellKind::kEmpty, nullptr};
  }

  /// Counters wrap: a cell that one store opened may be given back to another.
  SubdivideStats stats;

 private:
  const bool has_threshold_;
  Arena cells_, leaves_;
  BlockPool open_cells_;
};

}  // namespace whittle

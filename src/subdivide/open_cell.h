// A cell that is not known yet, and the pairs in which cells lie.
#pragma once

#include <cstdint>
#include <span>

#include "subdivide/cells.h"

namespace whittle {

/// What is known of it. Its formula is simplified for its box; the tokens stand behind, and then
/// which triangles of boundaries reach the cell.
struct OpenCell {
  Box box{};
  size_t memory = 0;  ///< its share: what it and all below it may take
  uint32_t depth = 0;
  uint32_t stalled = 0;     ///< splits since the formula last became shorter
  uint32_t literals = 0;    ///< of the formula, expanded
  bool is_crowded = false;  ///< boundaries are in it with many more triangles (Simplifier::Size)
  uint32_t token_count = 0;
  uint32_t near_count = 0;

  std::span<const Token> tokens() const {
    return {reinterpret_cast<const Token*>(this + 1), token_count};
  }
  /// See NearTriangles.
  std::span<const uint32_t> near() const {
    return {reinterpret_cast<const uint32_t*>(tokens().data() + token_count), near_count};
  }
  /// Of tokens and of what is near.
  size_t words() const { return size_t(token_count) + near_count; }
  static_assert(sizeof(Token) == sizeof(uint32_t));
  static size_t bytes(size_t words) { return sizeof(OpenCell) + words * sizeof(Token); }
};

/// Two cells in a row, aligned so that either tells where the pair begins. What follows them is
/// there only if there is a threshold: what each of them would be on its other side, and the last
/// move of it that changed one of them or anything below.
struct alignas(2 * sizeof(Cell)) CellPair {
  Cell cells[2];
  uint64_t across[2];
  uint64_t changed;
};

/// The pair of which a cell is one.
inline CellPair& pair_of(const Cell& cell) {
  const auto at = reinterpret_cast<uintptr_t>(&cell);
  return *reinterpret_cast<CellPair*>(at - at % alignof(CellPair));
}

/// What a cell of a pair would be if it were small and is not, or the other way round: the bits of
/// its link, and CellLink::kIfSmall in the first case. Open: not known yet. kNowhere: the same as
/// it is, or it is open and nobody knows at all.
inline uint64_t& across(const Cell& cell) {
  CellPair& pair = pair_of(cell);
  return pair.across[&cell == pair.cells ? 0 : 1];
}
inline constexpr uint64_t kNowhere = uint64_t(CellKind::kOpen);

}  // namespace whittle

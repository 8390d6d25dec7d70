// The cells: a binary tree of boxes. Each leaf has a formula that is right inside it and as short
// as can be. The tree does not depend on the view, unless a pixel threshold decides which cells are
// small; that threshold may move (threshold.h).
//
// The tree is lazy: cells start open, and whoever meets an open cell first refines it (refine.h).
// Cells and leaves never move in memory, and a cell that is no longer open changes only when a
// threshold moves. So any number of threads may read.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lower/scene.h"

namespace whittle {

enum class CellKind : uint8_t {
  kNode,         ///< split in two
  kEmpty,        ///< no point of it is in the solid
  kFull,         ///< every point is
  kIgnored,      ///< too small to matter, and small cells are to be ignored (the paper's rule)
  kConjunction,  ///< leaf: in the solid if inside all of its literals
  kDisjunction,  ///< leaf: if inside any of them
  kTable,        ///< leaf: a truth table over at most kTableLiterals literals
  kProgram,      ///< leaf: a jump program over any number of literals
  kOpen,         ///< not known yet: Refiner::refined() makes it one of the others
};
inline constexpr int kCellKinds = 9;
/// The kinds of leaves that rays solve.
inline constexpr bool is_leaf(CellKind kind) {
  return kind >= CellKind::kConjunction && kind <= CellKind::kProgram;
}
inline constexpr uint32_t kTableLiterals = 6;
/// Splits on the longest way down are no more than this, whatever the rules.
inline constexpr uint32_t kMostDepth = 160;

/// One literal of a leaf. In conjunctions and disjunctions it counts as written; tables and
/// programs go by whether a point is inside the half-space itself.
struct LeafLiteral {
  Literal literal;
  uint32_t owner;  ///< id of the primitive whose face it is; kSharedOwner: several share it
};
inline constexpr uint32_t kSharedOwner = 0;

/// One step of a jump program, after Rossignac's Blist (the paper's references 14 and 16): look at
/// a literal, go on to one of two steps, until the answer is reached.
struct Step {
  uint32_t literal;  ///< number within the leaf * 2 + 1 if its complement is meant
  uint32_t on_true, on_false;
};
inline constexpr uint32_t kAnswerTrue = UINT32_MAX, kAnswerFalse = UINT32_MAX - 1;

/// The head of a leaf's block of memory; literals, steps and tokens stand behind it in a row.
struct Leaf {
  /// Up to kTableLiterals literals, whatever the kind: bit s is the solid where bit i of s says
  /// "inside half-space i".
  uint64_t table = 0;
  uint32_t literal_count = 0;
  uint32_t step_count = 0;   ///< kProgram
  uint32_t token_count = 0;  ///< the leaf's formula, kept if an owner is shared

  std::span<const LeafLiteral> literals() const {
    return {reinterpret_cast<const LeafLiteral*>(this + 1), literal_count};
  }
  std::span<const Step> steps() const {
    return {reinterpret_cast<const Step*>(literals().data() + literal_count), step_count};
  }
  std::span<const Token> tokens() const {
    return {reinterpret_cast<const Token*>(steps().data() + step_count), token_count};
  }
  size_t bytes() const {
    return sizeof(Leaf) + literal_count * sizeof(LeafLiteral) + step_count * sizeof(Step) +
           token_count * sizeof(Token);
  }
};

struct Cell;

/// What a cell is and where to go on from it, in one word: the kind in bits 0 to 3, the axis in 4
/// and 5, then two bits that are not part of what the cell is, and from bit 8 on the target.
class CellLink {
 public:
  /// Of what a cell is across the threshold (open_cell.h): it is that if it is small.
  static constexpr uint64_t kIfSmall = 1u << 6;
  /// Of an open cell: a thread is at it (cell_claim.h).
  static constexpr uint64_t kBusy = 1u << 7;

  CellLink() = default;
  CellLink(CellKind kind, const void* target, int axis = 0)
      : bits_(uint64_t(reinterpret_cast<uintptr_t>(target)) << 8 | uint64_t(axis) << 4 |
              uint64_t(kind)) {}
  explicit CellLink(uint64_t bits) : bits_(bits) {}

  uint64_t bits() const { return bits_; }
  CellKind kind() const { return CellKind(bits_ & 15); }
  /// kNode: which axis is cut.
  int axis() const { return int(bits_ >> 4 & 3); }
  /// kNode: the first of two cells in a row; it lies below the split.
  const Cell* children() const { return static_cast<const Cell*>(target()); }
  /// Of the four kinds of leaves.
  const Leaf& leaf() const { return *static_cast<const Leaf*>(target()); }
  const void* target() const { return reinterpret_cast<const void*>(bits_ >> 8); }

 private:
  uint64_t bits_ = uint64_t(CellKind::kEmpty);
};

/// 16 bytes. The box is implied: the region, cut by every split on the way down.
struct Cell {
  mutable double split = 0;  ///< kNode: where the axis is cut
  mutable std::atomic<uint64_t> bits{CellLink().bits()};

  CellLink link() const { return CellLink(bits.load(std::memory_order_acquire)); }
};
static_assert(sizeof(Cell) == 16);

/// What there is so far. If a threshold has moved, cells below those that became small count, too.
struct SubdivideStats {
  std::array<uint64_t, kCellKinds> cells{};  ///< by CellKind
  std::vector<uint64_t> leaves_by_size;      ///< leaves with i literals
  uint32_t depth = 0;                        ///< splits on the longest way down
  uint64_t classified = 0;                   ///< operands looked at
  uint64_t refined = 0;                      ///< cells that were open and became something
  size_t memory_bytes = 0;

  uint64_t cell_count() const;
  uint64_t leaf_count() const;
};

class RefinerPool;

/// Copies share the cells.
struct CellTree {
  Box region;
  const Cell* root = nullptr;                 ///< the region's cell; null without a region
  double margin = 0;                          ///< leaves are right so far beyond their cells
  std::shared_ptr<RefinerPool> refiner_pool;  ///< owns the cells, knows how to refine them
};

/// Not while any cell is being refined.
SubdivideStats statistics_of(const CellTree& tree);

/// Calls visit(link, box) for every cell that is not split, open ones included, in a fixed order:
/// depth first, lower halves first.
template <class Visit>
void for_each_leaf(const CellTree& tree, Visit&& visit) {
  struct Item {
    const Cell* cell;
    Box box;
  };
  std::vector<Item> stack;
  if (tree.root != nullptr) stack.push_back({tree.root, tree.region});
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    const CellLink link = item.cell->link();
    if (link.kind() != CellKind::kNode) {
      visit(link, item.box);
      continue;
    }
    Item low{link.children(), item.box}, high{link.children() + 1, item.box};
    low.box.hi[link.axis()] = high.box.lo[link.axis()] = item.cell->split;
    stack.push_back(high);
    stack.push_back(low);
  }
}

}  // namespace whittle

// The cells: a binary tree of boxes, each leaf with a formula that is right inside it and as short
// as can be. View-independent, unless small cells are decided by a pixel threshold.
#pragma once

#include <array>
#include <cstdint>
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
};
inline constexpr int kCellKinds = 8;
inline constexpr uint32_t kTableLiterals = 6;

/// 16 bytes. The box is implied: the region, cut by every split on the way down.
struct Cell {
  double split = 0;    ///< kNode: where the axis is cut; the first child lies below
  uint32_t index = 0;  ///< kNode: first child in CellTree::cells, the second follows; leaf: number
  CellKind kind = CellKind::kEmpty;
  uint8_t axis = 0;
};

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

struct Leaf {
  /// Up to kTableLiterals literals, whatever the kind: bit s is the solid where bit i of s says
  /// "inside half-space i".
  uint64_t table = 0;
  uint32_t first_literal = 0, literal_count = 0;
  uint32_t first_step = 0, step_count = 0;    ///< kProgram
  uint32_t first_token = 0, token_count = 0;  ///< the leaf's formula, kept if an owner is shared
};

struct SubdivideStats {
  std::array<uint64_t, kCellKinds> cells{};  ///< by CellKind
  std::vector<uint64_t> leaves_by_size;      ///< leaves with i literals
  uint32_t depth = 0;                        ///< splits on the longest way down
  uint64_t classified = 0;                   ///< operands looked at
  size_t memory_bytes = 0;
};

struct CellTree {
  Box region;
  std::vector<Cell> cells;  ///< cells[0] is the region
  std::vector<Leaf> leaves;
  std::vector<LeafLiteral> literals;
  std::vector<Step> steps;
  Formula tokens;
  SubdivideStats stats;
};

}  // namespace whittle

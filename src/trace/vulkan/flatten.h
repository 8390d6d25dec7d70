// The cells as arrays of 32-bit words, as shaders read them. The layout is told here and in
// shaders/scene.glsl; only these two know it. This is the one place where the backend reads the
// cell tree.
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "subdivide/cells.h"
#include "trace/vulkan/leaf_case.h"
#include "trace/vulkan/sight.h"

namespace whittle {

/// What stands in a place of the host's tree: a node's number, or a number with this bit, or one of
/// the others.
inline constexpr uint32_t kCellBit = 1u << 31;    ///< a cell on the device
inline constexpr uint32_t kOpenPlace = 1u << 30;  ///< a cell that has not been looked at
inline constexpr uint32_t kNoChild = UINT32_MAX;  ///< nothing
constexpr bool is_cell(uint32_t what) {
  return what != kNoChild && (what & kCellBit) != 0;
}
constexpr bool is_node(uint32_t what) {
  return (what & (kCellBit | kOpenPlace)) == 0;
}

/// One split on the host's way through the cells, front to back.
struct FlatNode {
  double split = 0;
  const Cell* cells = nullptr;               ///< the two that stand for its children
  uint32_t child[2] = {kNoChild, kNoChild};  ///< what is below and above the split
  uint8_t axis = 0;
};

/// A place in the host's tree.
struct TreePlace {
  uint32_t parent = kNoChild;  ///< a node, or kNoChild: the tree's root
  uint32_t side = 0;
};

/// One cell to draw.
struct VisibleCell {
  uint32_t cell;
  LeafCase leaf_case;  ///< which shader is made for it
  /// It reaches to the eye's plane or far beyond the picture's sides, so its corners have no good
  /// place in the picture: every pixel must look.
  bool is_wide;
};

/// Cells, and the host's tree of them. Cells that are empty, full or ignored have no surface and
/// are left out.
struct FlatCells {
  /// For each cell that may be drawn: box (6 numbers); first literal (in `words`); kind, and how
  /// many literals (shader::kLeafBits); and the table, or the first step of the program and
  /// nothing.
  std::vector<uint32_t> cells;
  /// Literals (literal, owner) of each leaf, then the number of its owning steps and these (kind
  /// and operand, owner); and steps of programs (test, on true, on false).
  std::vector<uint32_t> words;

  /// What follows only the host has. Of each cell:
  std::vector<LeafCase> cases;
  std::vector<const Leaf*> leaves;
  std::vector<FlatNode> nodes;
  uint32_t root = kNoChild;

  /// What stands there; may be changed.
  uint32_t& at(TreePlace place) {
    return place.parent == kNoChild ? root : nodes[place.parent].child[place.side];
  }
};

/// For each half-space of the scene: centre (3 numbers), AlongKind, nothing; then of a plane b; of
/// a sphere its scale and c; of others diag, off, b, c.
std::vector<uint32_t> flatten_half_spaces(const Scene& scene, bool doubles);

class Refiner;

/// What is looked at of a cell's parts.
struct Wanted {
  const Sight* sight = nullptr;          ///< what it cannot see stays open; null: all is wanted
  const SolvedPixels* solved = nullptr;  ///< and so does what is hidden; null: nothing is
};

/// A part of the cells, by itself: its tree begins at its root.
struct FlatPart : FlatCells {
  /// Those of its cells that are seen, in the order in which rays meet them; with `sight`.
  std::vector<VisibleCell> visible;
};

/// Adds a cell and all below it to a part that is new, and refines what is open and wanted on the
/// way. `box`: the cell's. A kMachine error if a leaf is too large or nested too deeply for a
/// shader.
Status flatten(const Scene& scene, const Cell& cell, const Box& box, const Wanted& wanted,
               Refiner& refiner, bool doubles, FlatPart& part);

/// Puts a part into its place in the whole, of which `cells` and `words` stand before what
/// `whole.cells` and `whole.words` have. The part's cell numbers are then the whole's.
void append(FlatPart& part, TreePlace place, uint32_t cells, uint32_t words, FlatCells& whole);

}  // namespace whittle

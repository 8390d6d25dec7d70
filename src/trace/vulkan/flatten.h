// The cells as arrays of 32-bit words, as shaders read them. The layout is told here and in
// shaders/scene.glsl; only these two know it. This is the one place where the backend reads the
// cell tree.
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "subdivide/cells.h"
#include "trace/vulkan/leaf_case.h"

namespace whittle {

/// A number takes two words: a double's, or a float's and a zero.
inline constexpr uint32_t kHalfSpaceWords = 28;
inline constexpr uint32_t kCellWords = 16;

/// Groups inside of groups that a shader can follow when it looks for the owner of a shared face.
inline constexpr uint32_t kMostNested = 32;
/// Literals that it has room for in one cell.
inline constexpr uint32_t kMostLiterals = 1024;

/// One split on the host's way through the cells, front to back.
struct FlatNode {
  double split = 0;
  uint32_t child[2];  ///< below and above the split: a node, a cell | kCellBit, or kNoChild
  uint8_t axis = 0;
};
inline constexpr uint32_t kCellBit = 1u << 31;
inline constexpr uint32_t kNoChild = UINT32_MAX;

struct FlatCells {
  /// For each half-space: centre (3 numbers), kind, nothing; then of a plane b; of a sphere its
  /// scale and c; of others diag, off, b, c.
  std::vector<uint32_t> half_spaces;
  /// For each cell that must be drawn: box (6 numbers); first literal (in `words`), kind | literals
  /// << 2, and the table, or the first step of the program and nothing.
  std::vector<uint32_t> cells;
  /// And which shader is made for it; the host keeps that.
  std::vector<LeafCase> cases;
  /// Literals (literal, owner) of each leaf, then the number of its owning steps and these (kind |
  /// operand << 3, owner); and steps of programs (test, on true, on false).
  std::vector<uint32_t> words;

  Box region;
  std::vector<FlatNode> nodes;
  uint32_t root = kNoChild;

  uint32_t cell_count() const { return uint32_t(cells.size() / kCellWords); }
};

/// Precondition: all cells are refined. Cells that are empty, full or ignored have no surface and
/// are left out. A kMachine error if a leaf is too large or nested too deeply for a shader.
Result<FlatCells> flatten(const Scene& scene, const CellTree& tree, bool doubles);

}  // namespace whittle

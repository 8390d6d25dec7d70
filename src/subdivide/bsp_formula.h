// A partition of a cell as a formula: with h the half-space of a node, B what is said behind its
// plane and F what is said in front of it, (h and B) or (not h and F) (Thibault and Naylor, Set
// operations on polyhedra using binary space partitioning trees, 1987).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "subdivide/bsp_tree.h"
#include "subdivide/part_windings.h"

namespace whittle {

/// Its memory serves all cells.
class BspFormula {
 public:
  /// One operand, whose groups have no passes among them, over the faces of the planes; an empty
  /// group if it is constant.
  void write(const Scene& scene, const CellPolygons& in, const BspTree& tree,
             const PartWindings& windings, bool negated);

  std::span<const Token> tokens() const { return tokens_; }
  /// How many operands the outermost group has.
  uint32_t operands() const { return operands_; }

 private:
  /// A node's value once constants have gone.
  enum class Form : uint8_t {
    kFalse,
    kTrue,
    kOnlyFront,  ///< the plane is beside the cell
    kOnlyBack,
    kBehind,
    kInFront,
    kAnd,
    kAndNot,
    kOr,
    kOrNot,
    kBoth
  };

  enum class What : uint8_t { kNode, kBackHalf, kFrontHalf, kBehind, kInFront, kClose };
  /// Of a node, what is to be written of it; or the end of a group.
  struct Task {
    What what;
    TokenKind around;  ///< the group it stands in
    uint32_t depth;    ///< of that group
    uint32_t at;       ///< a node; kClose: a header
  };

  void find_forms(const CellPolygons& in, const BspTree& tree, const PartWindings& windings);

  std::vector<Form> forms_;  ///< by node
  std::vector<Task> tasks_;
  Formula tokens_;
  uint32_t operands_ = 0;
};

}  // namespace whittle

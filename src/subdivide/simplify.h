// Simplifies a formula to what matters in a cell, from the formula of the cell around it.
//
// Based on: the paper, section 2.2.1 (pruning sub-trees whose surface does not meet the cell), over
// half-spaces instead of primitives: what the cell lies inside or outside of becomes a constant,
// constants are propagated, groups left with one operand vanish.
#pragma once

#include <span>
#include <vector>

#include "lower/scene.h"
#include "subdivide/classify.h"

namespace whittle {

enum class Truth : uint8_t { kFalse, kTrue, kVaries };

class Simplifier {
 public:
  /// `margin`: how far a cell is grown before anything is classified, local units.
  Simplifier(const Scene& scene, double margin) : scene_(scene), margin_(margin) {}

  /// Writes to `out` the formula that equals `in` at every point of `cell`, operands in the same
  /// order; returns its truth, and leaves `out` empty if that is constant. A primitive is replaced by
  /// those of its faces that cross the cell as soon as the cell is no larger than it, or if
  /// `expand_all`. `in` and `out` must not overlap. Linear in `in` and the faces looked at; what a
  /// decided group holds is skipped.
  Truth simplify(std::span<const Token> in, const Box& cell, bool expand_all, Formula& out);

 private:
  struct Open {
    TokenKind kind;
    uint32_t in_end;
    uint32_t header;    ///< in `out`
    uint32_t operands;  ///< kept so far
  };
  Truth unit(Token token, const CellBox& cell, double cell_edge, bool expand_all, Formula& out,
             uint32_t& operands);

  const Scene& scene_;
  double margin_;
  std::vector<Open> open_;
};

/// Literals that a formula would have with all its primitives expanded.
uint32_t expanded_size(const Scene& scene, std::span<const Token> formula);

}  // namespace whittle

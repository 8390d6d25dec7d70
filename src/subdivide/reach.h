// Where the operands of a formula say something, by their boxes alone.
#pragma once

#include "lower/scene.h"

namespace whittle {

/// Of an operand: outside of the box its value is known.
struct OperandReach {
  Box box;
  bool outside = false;  ///< that value
};

/// Of a face or a unit.
inline OperandReach reach_of(const Scene& scene, Token token) {
  const uint32_t unit =
      token.kind() == TokenKind::kFace ? scene.faces[token.payload()].unit : token.payload();
  return {scene.units[unit].outer, token.negated()};
}

/// A conjunction is false outside of what its operands that are false outside have in common; if
/// there are none, it is true outside of all. A disjunction the other way round.
class ReachOfGroup {
 public:
  explicit ReachOfGroup(TokenKind kind) : absorbing_(kind == TokenKind::kOr) {}

  void add(const OperandReach& operand) {
    if (operand.outside == absorbing_) {
      common_ = any_ ? intersect(common_, operand.box) : operand.box;
      any_ = true;
    } else {
      all_ = unite(all_, operand.box);
    }
  }
  OperandReach result() const {
    return any_ ? OperandReach{common_, absorbing_} : OperandReach{all_, !absorbing_};
  }

 private:
  bool absorbing_, any_ = false;
  Box common_, all_;
};

}  // namespace whittle

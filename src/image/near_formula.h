// A formula of units that is evaluated at points, without looking at what is far from the point.
//
// Outside of its box a unit has a constant value. So has a group, and so has a row of a group's
// operands, outside of a box that follows from theirs. These boxes form a tree beside the formula.
// Rows hold eight operands, since a group may have thousands.
#pragma once

#include <cstdint>
#include <vector>

#include "lower/scene.h"

namespace whittle {

class NearFormula {
 public:
  /// `scene` must outlive this.
  explicit NearFormula(const Scene& scene);

  /// The value of the formula where the unit of number u has the value has(u) if the point is
  /// within `margin` of its box, and else none. Iterative.
  template <class Has>
  bool value_at(Vec3 p, double margin, Has&& has) const;

 private:
  /// Operands next to each other in one group, or one that is a group.
  struct Row {
    uint32_t begin = 0, end = 0;  ///< of their tokens
    uint32_t next = 0;            ///< the first row that is not within this one
    bool outside = false;         ///< the value where the box is not near
    Box box;
  };
  /// A row of operands of one group, taken for one operand. Precondition: there is one.
  static Row join(std::span<const Row> operands, bool conjunction);
  /// Adds rows of rows, so that the group has few.
  void gather(std::vector<Row> operands, bool conjunction);
  uint32_t unit_of(Token token) const {
    return token.kind() == TokenKind::kFace ? scene_.faces[token.payload()].unit : token.payload();
  }

  const Scene& scene_;
  std::vector<Row> rows_;  ///< each before those within it
};

/// Whether a point is in the box, or outside by no more than the margin on each axis.
inline bool is_near(const Box& box, Vec3 p, double margin) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < box.lo[axis] - margin || p[axis] > box.hi[axis] + margin) return false;
  return true;
}

template <class Has>
bool NearFormula::value_at(Vec3 p, double margin, Has&& has) const {
  struct Group {
    size_t end;
    bool conjunction, value;
  };
  std::vector<Group> open;
  const std::span<const Token> formula = scene_.formula;
  for (size_t i = 0, row = 0;;) {
    const Operand operand = operand_at(formula, i);
    i = operand.index;
    bool value = false, is_read = false;
    for (; row < rows_.size() && rows_[row].begin == i && !is_read; ++row) {
      const Row& r = rows_[row];
      if (is_near(r.box, p, margin)) continue;
      value = r.outside, is_read = true;
      i = r.end;
      row = r.next - 1;
    }
    if (!is_read) {
      const Token token = operand.token();
      ++i;
      if (operand.tokens.size() > 1) {
        open.push_back(
            {operand.end(), token.kind() == TokenKind::kAnd, token.kind() == TokenKind::kAnd});
        continue;
      }
      if (token.is_group()) {
        value = token.kind() == TokenKind::kAnd;
      } else {
        const uint32_t unit = unit_of(token);
        value = (is_near(scene_.units[unit].outer, p, margin) && has(unit)) != token.negated();
      }
    }
    for (;; open.pop_back()) {
      if (open.empty()) return value;
      Group& group = open.back();
      group.value = group.conjunction ? group.value && value : group.value || value;
      if (group.end != i) break;
      value = group.value;
    }
  }
}

}  // namespace whittle

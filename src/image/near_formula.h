// A formula of units that is evaluated at points, without looking at what is far from the point.
//
// Outside of its box a unit has a constant value. So has a group, and so has a row of a group's
// operands, outside of a box that follows from theirs. These boxes form a tree beside the formula.
// Rows hold eight operands, since a group may have thousands.
#pragma once

#include <cstdint>
#include <optional>
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
  bool value_at(Vec3 p, double margin, Has&& has) const {
    return look_at(p, margin, has).holds;
  }
  /// The unit that the point belongs to, as src/measure/material.h has it: of a union the first
  /// operand that holds it, of a conjunction the first. None if the formula does not hold there.
  template <class Has>
  std::optional<uint32_t> owner_at(Vec3 p, double margin, Has&& has) const {
    const Finding found = look_at(p, margin, has);
    if (!found.holds || found.owner == kNobody) return std::nullopt;
    return found.owner;
  }

 private:
  static constexpr uint32_t kNobody = UINT32_MAX;
  struct Finding {
    bool holds = false;
    uint32_t owner = kNobody;  ///< a unit
  };
  template <class Has>
  Finding look_at(Vec3 p, double margin, Has&& has) const;

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
NearFormula::Finding NearFormula::look_at(Vec3 p, double margin, Has&& has) const {
  struct Group {
    size_t end;
    bool conjunction;
    Finding found;

    void add(const Finding& operand) {
      const bool gives_owner = conjunction ? found.owner == kNobody : !found.holds && operand.holds;
      found.holds = conjunction ? found.holds && operand.holds : found.holds || operand.holds;
      if (gives_owner) found.owner = operand.owner;
    }
  };
  std::vector<Group> open;
  const std::span<const Token> formula = scene_.formula;
  for (size_t i = 0, row = 0;;) {
    const Operand operand = operand_at(formula, i);
    i = operand.index;
    Finding found;
    bool is_read = false;
    for (; row < rows_.size() && rows_[row].begin == i && !is_read; ++row) {
      const Row& r = rows_[row];
      if (is_near(r.box, p, margin)) continue;
      found.holds = r.outside, is_read = true;
      i = r.end;
      row = r.next - 1;
    }
    if (!is_read) {
      const Token token = operand.token();
      ++i;
      if (operand.tokens.size() > 1) {
        const bool conjunction = token.kind() == TokenKind::kAnd;
        open.push_back({operand.end(), conjunction, {conjunction, kNobody}});
        continue;
      }
      if (token.is_group()) {
        found.holds = token.kind() == TokenKind::kAnd;
      } else {
        const uint32_t unit = unit_of(token);
        found.holds =
            (is_near(scene_.units[unit].outer, p, margin) && has(unit)) != token.negated();
        if (!token.negated()) found.owner = unit;
      }
    }
    for (;; open.pop_back()) {
      if (open.empty()) return found;
      Group& group = open.back();
      group.add(found);
      if (group.end != i) break;
      found = group.found;
    }
  }
}

}  // namespace whittle

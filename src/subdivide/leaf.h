// From a formula of few literals to the leaf that is traced: truth table, conjunction, disjunction
// or jump program.
#pragma once

#include <span>
#include <vector>

#include "base/arena.h"
#include "subdivide/cells.h"

namespace whittle {

/// What is known about a formula once its half-spaces are listed.
class LeafAnalysis {
 public:
  explicit LeafAnalysis(const Scene& scene) : scene_(scene) {}

  /// Lists the half-spaces of a formula without units and, if they are at most six, computes its
  /// truth table and drops what the function does not depend on.
  void analyse(std::span<const Token> formula);

  /// Half-spaces that matter; 0 means the formula is constant (see constant_value).
  uint32_t size() const { return uint32_t(half_spaces_.size()); }
  bool constant_value() const { return table_ & 1; }
  /// Distinct primitives in the formula.
  uint32_t primitive_count() const { return primitive_count_; }
  /// All of its literals are in one conjunction, or in one disjunction.
  bool is_one_group() const { return is_one_group_; }
  /// A disjunction of uncomplemented primitives or faces only (the paper's case 2).
  bool is_plain_union() const;

  /// Writes the leaf into the arena. Precondition: size() > 0.
  CellLink write(Arena& arena);

 private:
  struct Used {
    uint32_t half_space;
    uint32_t owner;  ///< id of the body; kSharedOwner if faces of several lie on it
  };
  uint32_t position(uint32_t half_space) const;
  void compute_table();
  /// The kind of leaf; for conjunctions and disjunctions `out` gets the literals with their signs.
  CellKind signs(std::vector<Literal>& out) const;
  void make_program();

  const Scene& scene_;
  std::span<const Token> formula_;
  std::vector<Used> half_spaces_;
  std::vector<Literal> signs_;
  std::vector<Step> steps_;
  bool has_table_ = false, is_one_group_ = false;
  uint64_t table_ = 0;
  uint32_t primitive_count_ = 0;
};

}  // namespace whittle

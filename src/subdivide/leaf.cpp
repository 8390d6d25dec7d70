#include "subdivide/leaf.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "lower/evaluate.h"
#include "subdivide/truth_table.h"

namespace whittle {
namespace {

/// The table without literal i, on which it does not depend; later literals move down by one.
uint64_t without(uint64_t table, uint32_t i, uint32_t n) {
  uint64_t result = 0;
  for (uint32_t s = 0; s < (1u << (n - 1)); ++s) {
    const uint32_t low = s & ((1u << i) - 1);
    result |= (table >> ((s - low) * 2 + low) & 1) << s;
  }
  return result;
}

}  // namespace

void LeafAnalysis::analyse(std::span<const Token> formula) {
  formula_ = formula;
  half_spaces_.clear();
  primitive_count_ = 0;
  // Faces of one primitive stand next to each other, so counting changes counts primitives (a
  // primitive that stands twice counts twice, as it does in the tree).
  uint32_t last_unit = UINT32_MAX;
  bool has_and = false, has_or = false;
  for (const Token token : flat_tokens(formula)) {
    if (token.is_group()) {
      (token.kind() == TokenKind::kAnd ? has_and : has_or) = true;
      continue;
    }
    const Face& face = scene_.faces[token.payload()];
    if (face.unit != last_unit) ++primitive_count_;
    last_unit = face.unit;
    half_spaces_.push_back({face.literal >> 1, scene_.units[face.unit].id});
  }
  is_one_group_ = !has_and || !has_or;
  std::sort(half_spaces_.begin(), half_spaces_.end(),
            [](const Used& a, const Used& b) { return a.half_space < b.half_space; });
  size_t kept = 0;
  for (const Used& used : half_spaces_) {
    if (kept == 0 || half_spaces_[kept - 1].half_space != used.half_space)
      half_spaces_[kept++] = used;
    else if (half_spaces_[kept - 1].owner != used.owner)
      half_spaces_[kept - 1].owner = kSharedOwner;
  }
  half_spaces_.resize(kept);
  has_table_ = kept <= kTableLiterals;
  if (has_table_) compute_table();
}

uint32_t LeafAnalysis::position(uint32_t half_space) const {
  const auto found =
      std::lower_bound(half_spaces_.begin(), half_spaces_.end(), half_space,
                       [](const Used& used, uint32_t number) { return used.half_space < number; });
  return uint32_t(found - half_spaces_.begin());
}

void LeafAnalysis::compute_table() {
  uint32_t n = size();
  table_ = table_rows(n) & evaluate<uint64_t>(formula_, ~uint64_t(0), [&](Token token) {
             const Literal literal = scene_.faces[token.payload()].literal;
             const uint64_t inside = kTableOf[position(literal >> 1)];
             return bool(literal & 1) != token.negated() ? ~inside : inside;
           });
  // Drop, from the last, what the function does not depend on (equal cofactors).
  for (uint32_t i = n; i-- > 0;) {
    if (depends_on(table_, i)) continue;
    table_ = without(table_, i, n--);
    half_spaces_.erase(half_spaces_.begin() + i);
  }
}

bool LeafAnalysis::is_plain_union() const {
  // What an operand is: faces of the primitive of this number, or one of these.
  constexpr uint32_t kUnion = UINT32_MAX, kNeither = UINT32_MAX - 1, kNothingYet = UINT32_MAX - 2;
  struct Group {
    bool conjunction;
    uint32_t so_far = kNothingYet;

    void add(uint32_t operand) {
      // A conjunction is a primitive if all in it are faces of one.
      const bool fits = conjunction
                            ? operand < kNothingYet && (so_far == kNothingYet || so_far == operand)
                            : operand != kNeither && so_far != kNeither;
      so_far = !fits ? kNeither : conjunction ? operand : kUnion;
    }
    uint32_t result() const { return so_far; }
  };
  const auto begin = [](TokenKind kind) { return Group{kind == TokenKind::kAnd}; };
  const auto value = [&](Token token) {
    return token.negated() ? kNeither : scene_.faces[token.payload()].unit;
  };
  return fold(formula_, begin, value) != kNeither;
}

CellKind LeafAnalysis::signs(std::vector<Literal>& out) const {
  out.resize(size());
  if (has_table_) {
    // One row true: a conjunction. One row false: a disjunction. That row tells the signs.
    const int ones = std::popcount(table_);
    const bool conjunction = ones == 1;
    if (!conjunction && ones != (1 << size()) - 1) return CellKind::kTable;
    const uint32_t row = uint32_t(std::countr_zero(conjunction ? table_ : ~table_));
    for (uint32_t i = 0; i < size(); ++i)
      out[i] = half_spaces_[i].half_space * 2 + ((row >> i & 1) == uint32_t(conjunction) ? 0 : 1);
    return conjunction ? CellKind::kConjunction : CellKind::kDisjunction;
  }
  bool has_and = false, has_or = false;
  std::fill(out.begin(), out.end(), Literal(UINT32_MAX));
  for (const Token token : flat_tokens(formula_)) {
    if (token.is_group()) {
      (token.kind() == TokenKind::kAnd ? has_and : has_or) = true;
      continue;
    }
    const Literal literal = scene_.faces[token.payload()].literal ^ Literal(token.negated());
    Literal& known = out[position(literal >> 1)];
    // A literal beside its own complement: a constant that no table has found.
    if (known != UINT32_MAX && known != literal) return CellKind::kProgram;
    known = literal;
  }
  if (has_and == has_or) return CellKind::kProgram;
  return has_and ? CellKind::kConjunction : CellKind::kDisjunction;
}

CellLink LeafAnalysis::write(Arena& arena) {
  const CellKind kind = signs(signs_);
  const bool signed_literals = kind == CellKind::kConjunction || kind == CellKind::kDisjunction;
  steps_.clear();
  if (kind == CellKind::kProgram) make_program();
  const bool shared = std::any_of(half_spaces_.begin(), half_spaces_.end(),
                                  [](const Used& used) { return used.owner == kSharedOwner; });
  Leaf leaf;
  leaf.table = has_table_ ? table_ : 0;
  leaf.literal_count = size();
  leaf.step_count = uint32_t(steps_.size());
  leaf.token_count = shared ? uint32_t(formula_.size()) : 0;

  Leaf* const written = ::new (arena.allocate(leaf.bytes(), alignof(Leaf))) Leaf(leaf);
  auto* literal = const_cast<LeafLiteral*>(written->literals().data());
  for (uint32_t i = 0; i < size(); ++i) {
    const Used& used = half_spaces_[i];
    ::new (literal + i) LeafLiteral{signed_literals ? signs_[i] : used.half_space * 2, used.owner};
  }
  std::uninitialized_copy(steps_.begin(), steps_.end(), const_cast<Step*>(written->steps().data()));
  std::uninitialized_copy_n(formula_.begin(), leaf.token_count,
                            const_cast<Token*>(written->tokens().data()));
  return {kind, written};
}

void LeafAnalysis::make_program() {
  // A literal's step number is the number of literals before it, so the place where an operand ends
  // tells the step that follows it.
  std::vector<uint32_t> step_at(formula_.size() + 1, 0);
  for (size_t i = 0; i < formula_.size(); ++i)
    step_at[i + 1] = step_at[i] + (formula_[i].is_group() ? 0 : 1);
  // Where to go once a group's value is known.
  struct Open {
    size_t end;
    bool conjunction;
    uint32_t on_true, on_false;
  };
  std::vector<Open> open{{formula_.size(), true, kAnswerTrue, kAnswerFalse}};
  // Once this operand's value is known: a group that it decides goes to its own target, else to the
  // next operand.
  const auto targets = [&](const Operand& operand) {
    const Open& group = open.back();
    const bool last = operand.end() == group.end;
    const uint32_t next = step_at[operand.end()];
    return Open{operand.end(), operand.token().kind() == TokenKind::kAnd,
                group.conjunction && !last ? next : group.on_true,
                group.conjunction || last ? group.on_false : next};
  };
  const auto add_step = [&](const Operand& operand) {
    const Token token = operand.token();
    const Open to = targets(operand);
    const Literal literal = scene_.faces[token.payload()].literal;
    const bool complement = bool(literal & 1) != token.negated();
    steps_.push_back({position(literal >> 1) * 2 + complement, to.on_true, to.on_false});
  };
  walk(
      formula_, [&](const Operand& group) { open.push_back(targets(group)); }, add_step,
      [&] { open.pop_back(); });
}

}  // namespace whittle

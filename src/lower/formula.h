// A Boolean formula over half-spaces, as a flat prefix array of 32-bit tokens.
//
// Negation is pushed down to the literals (difference = and-not), so groups are conjunctions and
// disjunctions only, n-ary, operands in file order. A group's header holds its length, so a reader
// skips what is decided without looking at it. Order matters: ownership of coincident faces follows
// it (docs/conventions.md, tie rules), and simplification keeps it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace whittle {

/// Half-space number * 2, plus 1 for its complement.
using Literal = uint32_t;

enum class TokenKind : uint32_t {
  kFace,  ///< a literal that belongs to a primitive: index into Scene::faces
  kUnit,  ///< a whole primitive, the conjunction of its faces: index into Scene::units
  kAnd,   ///< header of a conjunction: length in tokens, itself included
  kOr,    ///< header of a disjunction
};

/// One token: kind (2 bits), negated (1 bit), payload (29 bits).
///
/// A negated kAnd or kOr is a pass: the header of what used to be a group. A group becomes a pass
/// when it has lost all but one operand, or comes to stand in a group of its own kind. The operands
/// behind a pass, at least one, belong to the group around it. The readers below skip passes.
struct Token {
  uint32_t bits;

  static constexpr uint32_t kMaxPayload = (1u << 29) - 1;
  static constexpr Token make(TokenKind kind, uint32_t payload, bool negated = false) {
    return {uint32_t(kind) << 30 | uint32_t(negated) << 29 | payload};
  }
  constexpr TokenKind kind() const { return TokenKind(bits >> 30); }
  constexpr bool negated() const { return bits >> 29 & 1; }
  constexpr uint32_t payload() const { return bits & kMaxPayload; }
  constexpr bool is_group() const { return bits >> 31; }
  constexpr bool is_pass() const { return is_group() && negated(); }
  bool operator==(const Token&) const = default;
};

/// A whole formula is one operand: a literal, a unit, or a group. An empty kOr is false, an empty
/// kAnd is true.
using Formula = std::vector<Token>;

/// One operand of a group, or a whole formula: a literal, a unit, or a group with all that is in
/// it.
struct Operand {
  std::span<const Token> tokens;
  size_t index = 0;  ///< in the formula, of the first of them

  Token token() const { return tokens[0]; }
  bool is_group() const { return token().is_group(); }
  size_t end() const { return index + tokens.size(); }
};

/// The operand whose first token stands there; passes before it are passed over.
inline Operand operand_at(std::span<const Token> formula, size_t index) {
  while (formula[index].is_pass()) ++index;
  const Token token = formula[index];
  return {formula.subspan(index, token.is_group() ? token.payload() : 1), index};
}

/// A formula as the one operand that it is.
inline Operand whole(std::span<const Token> formula) {
  return operand_at(formula, 0);
}

/// The operands of a group, in their order, those of passes in it among them.
class Operands {
 public:
  class Iterator {
   public:
    using value_type = Operand;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Operand operator*() const {
      const Operand found = operand_at(rest_, 0);
      return {found.tokens, index_ + found.index};
    }
    Iterator& operator++() {
      const size_t length = operand_at(rest_, 0).end();
      rest_ = rest_.subspan(length);
      index_ += length;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }
    bool operator==(std::default_sentinel_t) const { return rest_.empty(); }

   private:
    friend class Operands;
    explicit Iterator(Operand group) : rest_(group.tokens.subspan(1)), index_(group.index + 1) {}

    std::span<const Token> rest_;
    size_t index_ = 0;
  };

  explicit Operands(Operand group) : group_(group) {}
  Iterator begin() const { return Iterator(group_); }
  static std::default_sentinel_t end() { return {}; }

 private:
  Operand group_;
};

/// The operands of a group. Precondition: it is one.
inline Operands operands_of(Operand group) {
  return Operands(group);
}

/// All faces, units and groups' headers of a formula, in their order.
class FlatTokens {
 public:
  class Iterator {
   public:
    using value_type = Token;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    explicit Iterator(std::span<const Token> rest) : rest_(rest) { skip_passes(); }
    Token operator*() const { return rest_.front(); }
    Iterator& operator++() {
      rest_ = rest_.subspan(1);
      skip_passes();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(std::default_sentinel_t) const { return rest_.empty(); }

   private:
    void skip_passes() {
      while (!rest_.empty() && rest_.front().is_pass()) rest_ = rest_.subspan(1);
    }
    std::span<const Token> rest_;
  };

  explicit FlatTokens(std::span<const Token> formula) : formula_(formula) {}
  Iterator begin() const { return Iterator(formula_); }
  static std::default_sentinel_t end() { return {}; }

 private:
  std::span<const Token> formula_;
};
inline FlatTokens flat_tokens(std::span<const Token> formula) {
  return FlatTokens(formula);
}

/// Reads a formula from its first token to its last: calls enter(operand) where a group begins,
/// leave() where one ends, and visit(operand) for each face and unit. Iterative; linear.
template <class Enter, class Visit, class Leave>
void walk(std::span<const Token> formula, Enter&& enter, Visit&& visit, Leave&& leave) {
  std::vector<size_t> ends;
  for (size_t i = 0; i < formula.size();) {
    const Operand operand = operand_at(formula, i);
    i = operand.index + 1;
    if (operand.is_group()) {
      enter(operand);
      ends.push_back(operand.end());
    } else {
      visit(operand);
    }
    for (; !ends.empty() && ends.back() == i; ends.pop_back()) leave();
  }
}

/// From the bottom up: what a formula amounts to if value(token) is what a face or unit does, and
/// begin(kind) makes what takes the operands of a group one by one, with add(value), and has a
/// result(). Iterative; linear.
template <class Begin, class Value>
auto fold(std::span<const Token> formula, Begin&& begin, Value&& value) {
  using Group = decltype(begin(TokenKind::kAnd));
  struct Open {
    size_t end;
    Group group;
  };
  std::vector<Open> open;
  for (size_t i = 0;;) {
    const Operand operand = operand_at(formula, i);
    i = operand.index + 1;
    if (operand.tokens.size() > 1) {
      open.push_back({operand.end(), begin(operand.token().kind())});
      continue;
    }
    auto result =
        operand.is_group() ? begin(operand.token().kind()).result() : value(operand.token());
    // Hand it to the group around it, and close every group that this ends.
    for (; !open.empty(); open.pop_back()) {
      open.back().group.add(result);
      if (i < open.back().end) break;
      result = open.back().group.result();
    }
    if (open.empty()) return result;
  }
}

}  // namespace whittle

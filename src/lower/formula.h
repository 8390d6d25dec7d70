// A Boolean formula over half-spaces, as a flat prefix array of 32-bit tokens.
//
// Negation is pushed down to the literals (difference = and-not), so groups are conjunctions and
// disjunctions only, n-ary, operands in file order. A group's header holds its length, so a reader
// skips what is decided without looking at it. Order matters: ownership of coincident faces follows
// it (docs/conventions.md, tie rules), and simplification keeps it.
#pragma once

#include <cstdint>
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

/// One token: kind (2 bits), negated (1 bit), payload (29 bits). A negated kAnd or kOr is not a
/// group of its own: its operands belong to the group around it (what is left of a group that lost
/// all but one operand, or came to stand in one of its own kind).
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

}  // namespace whittle

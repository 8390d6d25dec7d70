#include "boundary/face_context.h"

#include <algorithm>

namespace whittle {
namespace {

/// By de Morgan.
Token complement(Token token) {
  if (!token.is_group()) return Token::make(token.kind(), token.payload(), !token.negated());
  const TokenKind other = token.kind() == TokenKind::kAnd ? TokenKind::kOr : TokenKind::kAnd;
  return Token::make(other, token.payload(), token.negated());
}

}  // namespace

bool context_of(const Scene& scene, std::span<const Token> formula, uint32_t unit, Formula& context,
                bool& is_negated) {
  const auto is_it = [&](Token token) {
    if (token.kind() == TokenKind::kUnit) return token.payload() == unit;
    return token.kind() == TokenKind::kFace && scene.faces[token.payload()].unit == unit;
  };
  const auto found = std::find_if(formula.begin(), formula.end(), is_it);
  if (found == formula.end()) return false;
  const auto its_index = size_t(found - formula.begin());
  is_negated = found->negated();
  context.assign(1, Token::make(TokenKind::kAnd, 1));
  Operand at = whole(formula);
  while (at.is_group()) {
    const bool is_or = at.token().kind() == TokenKind::kOr;
    Operand next = at;
    for (const Operand operand : operands_of(at)) {
      if (operand.index <= its_index && its_index < operand.end()) {
        next = operand;
      } else if (is_or) {
        std::transform(operand.tokens.begin(), operand.tokens.end(), std::back_inserter(context),
                       complement);
      } else {
        context.insert(context.end(), operand.tokens.begin(), operand.tokens.end());
      }
    }
    at = next;
  }
  context[0] = Token::make(TokenKind::kAnd, uint32_t(context.size()));
  return true;
}

}  // namespace whittle

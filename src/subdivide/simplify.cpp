#include "subdivide/simplify.h"

namespace whittle {
namespace {

Truth truth(Side side, bool negated) {
  if (side == Side::kCrosses) return Truth::kVaries;
  return (side == Side::kInside) != negated ? Truth::kTrue : Truth::kFalse;
}

}  // namespace

Truth Simplifier::unit(Token token, const CellBox& cell, double cell_edge, bool expand_all,
                       Formula& out, uint32_t& operands) {
  const Unit& unit = scene_.units[token.payload()];
  const bool negated = token.negated();
  const Side side = classify_bounds(unit, cell);
  if (side != Side::kCrosses) return truth(side, negated);
  if (!expand_all && cell_edge > max_component(unit.outer.size())) {
    out.push_back(token);
    return Truth::kVaries;
  }
  const size_t header = out.size();
  out.push_back({});
  for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f) {
    const Side face = classify(scene_, scene_.faces[f].literal, cell);
    if (face == Side::kOutside) {
      out.resize(header);
      return truth(face, negated);
    }
    if (face == Side::kCrosses) out.push_back(Token::make(TokenKind::kFace, f, negated));
  }
  const uint32_t size = uint32_t(out.size() - header);
  if (size == 1) {
    out.resize(header);
    return truth(Side::kInside, negated);
  }
  // The complement of a conjunction is the disjunction of complements.
  const TokenKind kind = negated ? TokenKind::kOr : TokenKind::kAnd;
  const bool merges = !open_.empty() && open_.back().kind == kind;
  if (merges) operands = size - 1;
  out[header] = Token::make(kind, size, merges || size == 2);
  return Truth::kVaries;
}

Truth Simplifier::simplify(std::span<const Token> in, const Box& cell_box, bool expand_all,
                           Formula& out) {
  const CellBox cell(cell_box, margin_);
  const double cell_edge = max_component(cell_box.size());
  out.clear();
  open_.clear();
  uint32_t i = 0;
  while (true) {
    // One operand.
    const Token token = in[i];
    Truth value = Truth::kVaries;
    uint32_t operands = 1;  // of the group around, that this one amounts to
    if (token.is_pass()) {
      ++i;
      continue;
    }
    if (token.is_group() && token.payload() > 1) {
      open_.push_back({token.kind(), i + token.payload(), uint32_t(out.size()), 0});
      out.push_back(token);
      ++i;
      continue;
    }
    if (token.is_group()) {
      value = token.kind() == TokenKind::kAnd ? Truth::kTrue : Truth::kFalse;
    } else if (token.kind() == TokenKind::kUnit) {
      value = unit(token, cell, cell_edge, expand_all, out, operands);
    } else {
      value = truth(classify(scene_, scene_.faces[token.payload()].literal, cell), token.negated());
      if (value == Truth::kVaries) out.push_back(token);
    }
    ++i;

    // Hand its value to the group around it, and close every group that this ends.
    while (true) {
      if (open_.empty()) return value;
      Open& group = open_.back();
      const Truth absorbing = group.kind == TokenKind::kAnd ? Truth::kFalse : Truth::kTrue;
      if (value == absorbing) {
        out.resize(group.header);
        i = group.in_end;
      } else {
        if (value == Truth::kVaries) group.operands += operands;
        if (i < group.in_end) break;
        if (group.operands == 0) {
          value = absorbing == Truth::kFalse ? Truth::kTrue : Truth::kFalse;
          out.resize(group.header);
        } else {
          value = Truth::kVaries;
          const bool merges = open_.size() > 1 && open_[open_.size() - 2].kind == group.kind;
          operands = merges ? group.operands : 1;
          out[group.header] = Token::make(group.kind, uint32_t(out.size()) - group.header,
                                          merges || group.operands == 1);
        }
      }
      open_.pop_back();
    }
  }
}

uint32_t expanded_size(const Scene& scene, std::span<const Token> formula) {
  uint32_t count = 0;
  for (const Token token : formula) {
    if (token.kind() == TokenKind::kFace) ++count;
    if (token.kind() == TokenKind::kUnit) count += scene.units[token.payload()].face_count;
  }
  return count;
}

}  // namespace whittle

#include "subdivide/simplify.h"

namespace whittle {
namespace {

Truth truth(Side side, bool negated) {
  if (side == Side::kCrosses) return Truth::kVaries;
  return (side == Side::kInside) != negated ? Truth::kTrue : Truth::kFalse;
}

}  // namespace

/// True if a group of this kind, `depth` groups below the top, stands in one of its own kind.
bool Simplifier::joins_group_around(TokenKind kind, size_t depth) const {
  return depth > 0 && open_[depth - 1].kind == kind;
}

Truth Simplifier::unit(Token token, const CellBox& cell, double cell_edge, bool expand_all,
                       Formula& out, Kept& kept) {
  const Unit& unit = scene_.units[token.payload()];
  const bool negated = token.negated();
  const Side side = classify_bounds(unit, cell);
  if (side != Side::kCrosses) return truth(side, negated);
  if (!expand_all && cell_edge > max_component(unit.outer.size())) {
    out.push_back(token);
    return Truth::kVaries;
  }
  // The complement of a conjunction is the disjunction of complements.
  Open faces{negated ? TokenKind::kOr : TokenKind::kAnd, 0, uint32_t(out.size()), 0, {}};
  out.push_back({});
  for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f) {
    const Side face = classify(scene_, scene_.faces[f].literal, cell);
    if (face == Side::kOutside) {
      out.resize(faces.header);
      return truth(face, negated);
    }
    if (face == Side::kInside) continue;
    out.push_back(Token::make(TokenKind::kFace, f, negated));
    ++faces.operands;
  }
  if (faces.operands == 0) {
    out.resize(faces.header);
    return truth(Side::kInside, negated);
  }
  open_.push_back(faces);
  kept = close_group(faces, out);
  open_.pop_back();
  return Truth::kVaries;
}

/// Writes the header of the innermost open group, which has kept at least one operand.
Simplifier::Kept Simplifier::close_group(const Open& group, Formula& out) const {
  const size_t depth = open_.size() - 1;
  const uint32_t length = uint32_t(out.size()) - group.header;
  if (joins_group_around(group.kind, depth)) {
    out[group.header] = Token::make(group.kind, length, true);
    return {group.operands, kNone, 0};
  }
  if (group.operands > 1) {
    out[group.header] = Token::make(group.kind, length);
    return {1, group.header, group.operands};
  }
  // One operand is left, which takes the group's place. If it is a group, it may now stand in one
  // of its own kind.
  out[group.header] = Token::make(group.kind, length, true);
  const Kept& only = group.last;
  if (only.header == kNone || !joins_group_around(out[only.header].kind(), depth)) return only;
  const Token header = out[only.header];
  out[only.header] = Token::make(header.kind(), header.payload(), true);
  return {only.in_group, kNone, 0};
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
    Kept kept;
    if (token.is_pass()) {
      ++i;
      continue;
    }
    if (token.is_group() && token.payload() > 1) {
      open_.push_back({token.kind(), i + token.payload(), uint32_t(out.size()), 0, {}});
      out.push_back(token);
      ++i;
      continue;
    }
    if (token.is_group()) {
      value = token.kind() == TokenKind::kAnd ? Truth::kTrue : Truth::kFalse;
    } else if (token.kind() == TokenKind::kUnit) {
      value = unit(token, cell, cell_edge, expand_all, out, kept);
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
        if (value == Truth::kVaries) {
          group.operands += kept.operands;
          group.last = kept;
        }
        if (i < group.in_end) break;
        if (group.operands == 0) {
          value = absorbing == Truth::kFalse ? Truth::kTrue : Truth::kFalse;
          out.resize(group.header);
        } else {
          value = Truth::kVaries;
          kept = close_group(group, out);
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

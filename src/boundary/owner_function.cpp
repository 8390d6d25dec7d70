#include "boundary/owner_function.h"

#include <algorithm>

namespace whittle {
namespace {

enum class Known : uint8_t { kNo, kYes, kNotYet };

}  // namespace

/// Of an operand below and above the plane.
struct OwnerFunction::Value {
  Known below, above;
  uint32_t asks = 0;  ///< if one of them is not known yet

  bool is_known() const { return below != Known::kNotYet && above != Known::kNotYet; }
};

void OwnerFunction::set(CellLink link, const Scene& scene,
                        std::span<const PlacedHalfSpace> half_spaces, LocalPlanes& local,
                        uint32_t own) {
  scene_ = &scene;
  half_spaces_ = half_spaces;
  local_ = &local;
  formula_ = {};
  own_ = own;
  only_ = kSharedOwner;
  if (!is_leaf(link.kind())) return;
  const uint32_t plane = local.all()[own];
  bool is_shared = false;
  for (const LeafLiteral& literal : link.leaf().literals()) {
    if (half_spaces[literal.literal >> 1].plane != plane) continue;
    is_shared = is_shared || literal.owner == kSharedOwner;
    if (only_ == kSharedOwner || literal.owner < only_) only_ = literal.owner;
  }
  if (!is_shared) return;
  formula_ = link.leaf().tokens();
  for (const Token token : flat_tokens(formula_))
    if (!token.is_group()) local.add(half_spaces[scene.faces[token.payload()].literal >> 1].plane);
}

OwnerFunction::Value OwnerFunction::value_of(Token token, std::span<const PlaneSide> sides) const {
  const Literal literal = scene_->faces[token.payload()].literal;
  const PlacedHalfSpace& placed = half_spaces_[literal >> 1];
  const uint32_t number = local_->number(placed.plane);
  const bool is_turned = bool(literal & 1) != token.negated();
  const auto known = [&](PlaneSide side) {
    return (side == placed.inside) != is_turned ? Known::kYes : Known::kNo;
  };
  if (number == own_) return {known(-1), known(1)};
  const PlaneSide side = sides[number];
  if (side == 0) return {Known::kNotYet, Known::kNotYet, number};
  return {known(side), known(side)};
}

OwnerFunction::Answer OwnerFunction::at(std::span<const PlaneSide> sides) const {
  if (formula_.empty()) return {only_};
  struct Group {
    Known decides;
    Value so_far;

    void add(const Value& operand) {
      if (so_far.is_known()) so_far.asks = operand.asks;
      so_far.below = both(so_far.below, operand.below);
      so_far.above = both(so_far.above, operand.above);
    }
    Known both(Known a, Known b) const {
      if (a == decides || b == decides) return decides;
      return a == Known::kNotYet ? a : b;
    }
    Value result() const { return so_far; }
  };
  const auto begin = [](TokenKind kind) {
    const bool is_and = kind == TokenKind::kAnd;
    const Known neutral = is_and ? Known::kYes : Known::kNo;
    return Group{is_and ? Known::kNo : Known::kYes, {neutral, neutral}};
  };
  const auto value = [&](Token token) { return value_of(token, sides); };
  Operand at = whole(formula_);
  while (at.is_group()) {
    Operand chosen = at;
    for (const Operand operand : operands_of(at)) {
      const Value its = fold(operand.tokens, begin, value);
      if (!its.is_known()) return {kSharedOwner, true, its.asks};
      if (its.below == its.above) continue;
      chosen = operand;
      break;
    }
    if (chosen.index == at.index) return {};  // The other side of the plane is another cell's.
    at = chosen;
  }
  return {scene_->units[scene_->faces[at.token().payload()].unit].id};
}

}  // namespace whittle

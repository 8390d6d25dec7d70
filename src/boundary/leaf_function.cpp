#include "boundary/leaf_function.h"

#include <optional>

namespace whittle {

void LocalPlanes::clear() {
  for (const uint32_t plane : planes_) numbers_[plane] = kNone;
  planes_.clear();
}

uint32_t LocalPlanes::add(uint32_t plane) {
  uint32_t& number = numbers_[plane];
  if (number == kNone) {
    number = uint32_t(planes_.size());
    planes_.push_back(plane);
  }
  return number;
}

void LeafFunction::set(CellLink link, std::span<const PlacedHalfSpace> half_spaces,
                       LocalPlanes& local) {
  link_ = link;
  literals_.clear();
  if (!is_leaf(link.kind())) return;
  for (const LeafLiteral& literal : link.leaf().literals()) {
    const PlacedHalfSpace& placed = half_spaces[literal.literal >> 1];
    literals_.push_back({local.add(placed.plane), placed.inside, bool(literal.literal & 1)});
  }
}

std::optional<bool> LeafFunction::is_inside(const Literal& literal,
                                            std::span<const PlaneSide> sides) const {
  const PlaneSide side = sides[literal.local];
  if (side == 0) return std::nullopt;
  return side == literal.inside;
}

void LeafFunction::learn(State& state, uint32_t local_plane, PlaneSide side) const {
  if (!has_table()) return;
  for (uint32_t i = 0; i < literals_.size(); ++i) {
    if (literals_[i].local != local_plane) continue;
    // Both halves of the table become the one that is known to hold.
    const unsigned width = 1u << i;
    const bool inside = side == literals_[i].inside;
    const uint64_t half = inside ? state.table & kTableOf[i] : state.table & ~kTableOf[i];
    state.table = inside ? half | half >> width : half | half << width;
  }
}

LeafFunction::Answer LeafFunction::at(State& state, std::span<const PlaneSide> sides) const {
  if (link_.kind() == CellKind::kEmpty) return {false};
  if (link_.kind() == CellKind::kFull) return {true};
  if (has_table()) return by_table(state.table);
  return link_.kind() == CellKind::kProgram ? by_program(sides, state.step) : by_group(sides);
}

LeafFunction::Answer LeafFunction::by_table(uint64_t table) const {
  if (table == 0) return {false};
  if (table == rows()) return {true};
  for (uint32_t i = 0; i < literals_.size(); ++i)
    if (depends_on(table, i)) return {std::nullopt, literals_[i].local};
  return {false};
}

LeafFunction::Answer LeafFunction::by_group(std::span<const PlaneSide> sides) const {
  const bool neutral = link_.kind() == CellKind::kConjunction;
  const Literal* open = nullptr;
  for (const Literal& literal : literals_) {
    const std::optional<bool> inside = is_inside(literal, sides);
    if (!inside)
      open = open == nullptr ? &literal : open;
    else if ((*inside != literal.negated) != neutral)
      return {!neutral};
  }
  if (open != nullptr) return {std::nullopt, open->local};
  return {neutral};
}

LeafFunction::Answer LeafFunction::by_program(std::span<const PlaneSide> sides,
                                              uint32_t& at) const {
  const std::span<const Step> steps = link_.leaf().steps();
  while (at < kAnswerFalse) {
    const Step& step = steps[at];
    const Literal& literal = literals_[step.literal >> 1];
    const std::optional<bool> inside = is_inside(literal, sides);
    if (!inside) return {std::nullopt, literal.local};
    at = *inside != bool(step.literal & 1) ? step.on_true : step.on_false;
  }
  return {at == kAnswerTrue};
}

uint32_t LeafFunction::owner(const Scene& scene, uint32_t local_plane) const {
  uint32_t first = kSharedOwner;
  const auto take = [&](uint32_t id) {
    if (first == kSharedOwner || id < first) first = id;
  };
  for (size_t i = 0; i < literals_.size(); ++i) {
    if (literals_[i].local != local_plane) continue;
    const LeafLiteral& literal = link_.leaf().literals()[i];
    if (literal.owner != kSharedOwner) {
      take(literal.owner);
      continue;
    }
    for (const Token token : flat_tokens(link_.leaf().tokens())) {
      if (token.is_group()) continue;
      const Face& face = scene.faces[token.payload()];
      if (face.literal >> 1 == literal.literal >> 1) take(scene.units[face.unit].id);
    }
  }
  return first;
}

}  // namespace whittle

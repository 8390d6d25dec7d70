#include "trace/cpu/solve.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>

#include "lower/evaluate.h"
#include "model/instances.h"

namespace whittle {
namespace {

using K = Kernels<double>;

/// So many crossings, and no more, are sorted by insertion.
constexpr size_t kFewCrossings = 32;

}  // namespace

LeafSolver::LeafSolver(const Scene& scene)
    : scene_(scene),
      ray_tolerance_(
          ray_tolerance({scene.region.lo + scene.origin, scene.region.hi + scene.origin})) {}

void LeafSolver::add_crossings(uint32_t number, const LiteralOnRay& literal, double t0, double t1) {
  const auto add = [&](bool rising) {
    // The signs say that it is in (t0, t1]; rounding may not.
    crossings_.push_back(
        {std::min(std::max(K::along_root(literal.along, rising), t0), t1), number});
  };
  // f rises where the ray leaves the half-space.
  add(literal.inside);
  if (literal.bends) add(!literal.inside);
}

/// By t, those of equal t in the literals' order.
void LeafSolver::sort_crossings() {
  if (crossings_.size() > kFewCrossings) {
    std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
      const auto order = std::strong_order(a.t, b.t);
      return order != 0 ? order < 0 : a.literal < b.literal;
    });
    return;
  }
  for (size_t i = 1; i < crossings_.size(); ++i) {
    const Crossing crossing = crossings_[i];
    size_t at = i;
    for (; at > 0 && crossings_[at - 1].t > crossing.t; --at) crossings_[at] = crossings_[at - 1];
    crossings_[at] = crossing;
  }
}

void LeafSolver::start() {
  const std::span<const LeafLiteral> literals = leaf_->literals();
  next_ = 0;
  state_ = 0;
  count_ = 0;
  if (kind_ == CellKind::kTable) {
    for (uint32_t i = 0; i < literals.size(); ++i) state_ |= uint64_t(is_inside_[i]) << i;
  } else if (kind_ == CellKind::kProgram) {
    path_.clear();
    known_ = 0;
    on_path_.resize(literals.size());
  } else {
    for (uint32_t i = 0; i < literals.size(); ++i)
      count_ += literal_value(literals[i], is_inside_[i]);
  }
  solid_ = value();
}

void LeafSolver::flip(uint32_t literal) {
  is_inside_[literal] ^= 1;
  if (kind_ == CellKind::kTable) {
    state_ ^= uint64_t(1) << literal;
  } else if (kind_ == CellKind::kProgram) {
    const uint32_t at = on_path_[literal];
    if (at < known_ && leaf_->steps()[path_[at]].literal >> 1 == literal) known_ = at;
  } else if (literal_value(leaf_->literals()[literal], is_inside_[literal])) {
    ++count_;
  } else {
    --count_;
  }
}

bool LeafSolver::value() {
  switch (kind_) {
    case CellKind::kConjunction:
      return count_ == leaf_->literal_count;
    case CellKind::kDisjunction:
      return count_ > 0;
    case CellKind::kTable:
      return leaf_->table >> state_ & 1;
    default:
      return program_value();
  }
}

bool LeafSolver::program_value() {
  if (known_ == path_.size() && !path_.empty()) return answer_;
  const Step* const steps = leaf_->steps().data();
  uint32_t at = path_.empty() ? 0 : path_[known_];
  path_.resize(known_);
  while (at < kAnswerFalse) {
    const Step& step = steps[at];
    const uint32_t literal = step.literal >> 1, first = on_path_[literal];
    if (first >= path_.size() || steps[path_[first]].literal >> 1 != literal)
      on_path_[literal] = uint32_t(path_.size());
    path_.push_back(at);
    at = is_inside_[literal] != (step.literal & 1) ? step.on_true : step.on_false;
  }
  known_ = path_.size();
  answer_ = at == kAnswerTrue;
  return answer_;
}

size_t LeafSolver::decisive(std::span<const Crossing> group) {
  if (group.size() == 1) return 0;
  const bool after = value();
  const auto value_without = [&](auto&& left_out) {
    const auto flip_those = [&] {
      for (size_t i = 0; i < group.size(); ++i)
        if (left_out(i)) flip(group[i].literal);
    };
    flip_those();
    const bool result = value();
    flip_those();
    return result;
  };
  for (size_t n = 0; n < group.size(); ++n) {
    const bool is_needed = value_without([n](size_t i) { return i == n; }) != after;
    if (is_needed || value_without([n](size_t i) { return i != n; }) == after) return n;
  }
  return 0;
}

bool LeafSolver::differs(Inside inside) const {
  return inside != Inside::kUnknown && solid_ != (inside == Inside::kYes);
}

Change LeafSolver::change_at_start(const LocalRay& ray, double t0, uint32_t nearest) {
  ++disagreements;
  const Crossing here{t0, nearest};
  return describe(ray, t0, {&here, 1}, solid_);
}

bool LeafSolver::next_change(const LocalRay& ray, Inside& inside, Change& change) {
  while (next_ < crossings_.size()) {
    const size_t first = next_;
    const double t = crossings_[first].t;
    // The first one in any case: where numbers overflow, t may be none.
    do flip(crossings_[next_].literal);
    while (++next_ < crossings_.size() && crossings_[next_].t <= t + ray_tolerance_);
    const bool after = value();
    if (after == solid_) continue;
    solid_ = after;
    const std::span<Crossing> group(&crossings_[first], next_ - first);
    std::ranges::sort(group, {}, &Crossing::literal);  // the order of the file
    std::swap(group[0], group[decisive(group)]);
    change = describe(ray, t, group, after);
    return true;
  }
  inside = solid_ ? Inside::kYes : Inside::kNo;
  return false;
}

Change LeafSolver::describe(const LocalRay& ray, double t, std::span<const Crossing> group,
                            bool solid_after) const {
  const std::span<const LeafLiteral> literals = leaf_->literals();
  uint32_t literal = group[0].literal;
  uint32_t id = literals[literal].owner;
  if (id == kSharedOwner || (group.size() > 1 && leaf_->token_count > 0)) {
    const Face& face = owner(*leaf_, literals, ray.origin + ray.direction * t, group);
    id = scene_.units[face.unit].id;
    for (const Crossing& crossing : group)
      if (literals[crossing.literal].literal >> 1 == face.literal >> 1) literal = crossing.literal;
  }
  // Out of the half-space is out of the solid too if both were entered or both left.
  return {t, id, literals[literal].literal >> 1, bool(is_inside_[literal]) != solid_after,
          solid_after};
}

uint32_t LeafSolver::owner_of(const Leaf& leaf, uint64_t state, uint32_t literal) {
  const uint64_t key = (reinterpret_cast<uintptr_t>(&leaf) >> 3) ^ state * 5 ^ literal * 37;
  KnownOwner& known = known_owners_[key % kKnownOwners];
  if (known.leaf == &leaf && known.state == state && known.literal == literal) return known.id;
  const std::span<const LeafLiteral> literals = leaf.literals();
  const bool by_literals = std::ranges::all_of(leaf.tokens(), [&](Token token) {
    return token.is_group() || std::ranges::any_of(literals, [&](const LeafLiteral& l) {
             return l.literal >> 1 == scene_.faces[token.payload()].literal >> 1;
           });
  });
  uint32_t id = kSharedOwner;
  if (by_literals) {
    is_inside_.resize(literals.size());
    for (uint32_t i = 0; i < literals.size(); ++i) is_inside_[i] = state >> i & 1;
    const Crossing crossing{0, literal};
    id = scene_.units[owner(leaf, literals, Vec3{}, {&crossing, 1}).unit].id;
  }
  known = {&leaf, state, literal, id};
  return id;
}

const Face& LeafSolver::owner(const Leaf& leaf, std::span<const LeafLiteral> literals, Vec3 point,
                              std::span<const Crossing> group) const {
  const std::span<const Token> formula = leaf.tokens();
  // Bit 0: before the change, bit 1: after it.
  const auto value = [&](Token token) -> uint8_t {
    const Literal face = scene_.faces[token.payload()].literal;
    uint8_t both = contains(scene_.half_spaces[face >> 1], point) ? 3 : 0;
    for (uint32_t i = 0; i < literals.size(); ++i) {
      if (literals[i].literal >> 1 != face >> 1) continue;
      both = is_inside_[i] ? 3 : 0;
      for (const Crossing& crossing : group)
        if (crossing.literal == i) both ^= 1;
    }
    return bool(face & 1) != token.negated() ? uint8_t(both ^ 3) : both;
  };
  const auto changes = [&](const Operand& operand) {
    const uint8_t both = evaluate<uint8_t>(operand.tokens, 3, value);
    return both == 1 || both == 2;
  };
  // Down the tree, at each group into the first operand that changes.
  Operand at = whole(formula);
  while (at.is_group()) {
    const Operands operands = operands_of(at);
    const auto chosen = std::ranges::find_if(operands, changes);
    if (chosen == operands.end()) {
      // No operand changes here: the neighbouring cell did not see this change, so its half-space
      // was on the other side of rounding. The first face on that half-space has it.
      const uint32_t half_space = literals[group[0].literal].literal >> 1;
      const auto is_on_it = [&](Token token) {
        return !token.is_group() && scene_.faces[token.payload()].literal >> 1 == half_space;
      };
      const auto found = std::ranges::find_if(formula, is_on_it);
      return scene_.faces[(found == formula.end() ? formula.back() : *found).payload()];
    }
    at = *chosen;
  }
  return scene_.faces[at.token().payload()];
}

}  // namespace whittle

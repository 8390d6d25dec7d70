#include "trace/cpu/solve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lower/evaluate.h"
#include "model/instances.h"

namespace whittle {
namespace {

using K = Kernels<double>;

}  // namespace

LeafSolver::LeafSolver(const Scene& scene)
    : scene_(scene),
      together_(together({scene.region.lo + scene.origin, scene.region.hi + scene.origin})) {}

void LeafSolver::add_crossing(double t, uint32_t literal) {
  // Insertion keeps the list sorted; it is short, and equal times stay in the literals' order.
  size_t at = crossings_.size();
  crossings_.push_back({t, literal});
  for (; at > 0 && crossings_[at - 1].t > t; --at) crossings_[at] = crossings_[at - 1];
  crossings_[at] = {t, literal};
}

void LeafSolver::list_crossings(std::span<const LiteralOnRay> on_ray, double t0, double t1) {
  crossings_.clear();
  is_inside_.resize(on_ray.size());
  for (uint32_t i = 0; i < on_ray.size(); ++i) {
    const LiteralOnRay& l = on_ray[i];
    is_inside_[i] = l.inside;
    const auto root = [&](bool rising) {
      // The signs say that it is in (t0, t1]; rounding may not.
      return std::min(std::max(K::along_root(l.along, rising), t0), t1);
    };
    // f rises where the ray leaves the half-space.
    if (l.changes || l.bends) add_crossing(root(l.inside), i);
    if (l.bends) add_crossing(root(!l.inside), i);
  }
}

void LeafSolver::start(CellKind kind, const Leaf& leaf, std::span<const LeafLiteral> literals) {
  state_ = 0;
  count_ = 0;
  if (kind == CellKind::kTable)
    for (uint32_t i = 0; i < leaf.literal_count; ++i) state_ |= uint64_t(is_inside_[i]) << i;
  else if (kind != CellKind::kProgram)
    for (uint32_t i = 0; i < leaf.literal_count; ++i)
      count_ += literal_value(literals[i], is_inside_[i]);
}

void LeafSolver::flip(CellKind kind, std::span<const LeafLiteral> literals, uint32_t literal) {
  is_inside_[literal] ^= 1;
  if (kind == CellKind::kTable)
    state_ ^= uint64_t(1) << literal;
  else if (literal_value(literals[literal], is_inside_[literal]))
    ++count_;
  else
    --count_;
}

bool LeafSolver::value(CellKind kind, const Leaf& leaf,
                       std::span<const LeafLiteral> literals) const {
  switch (kind) {
    case CellKind::kConjunction:
      return count_ == literals.size();
    case CellKind::kDisjunction:
      return count_ > 0;
    case CellKind::kTable:
      return leaf.table >> state_ & 1;
    default: {
      const Step* steps = leaf.steps().data();
      uint32_t at = 0;
      while (at < kAnswerFalse) {
        const Step& step = steps[at];
        at = is_inside_[step.literal >> 1] != (step.literal & 1) ? step.on_true : step.on_false;
      }
      return at == kAnswerTrue;
    }
  }
}

size_t LeafSolver::decisive(CellKind kind, const Leaf& leaf, std::span<const LeafLiteral> literals,
                            std::span<const Crossing> group) {
  if (group.size() == 1) return 0;
  const bool after = value(kind, leaf, literals);
  const auto value_without = [&](auto&& left_out) {
    const auto flip_those = [&] {
      for (size_t i = 0; i < group.size(); ++i)
        if (left_out(i)) flip(kind, literals, group[i].literal);
    };
    flip_those();
    const bool result = value(kind, leaf, literals);
    flip_those();
    return result;
  };
  for (size_t n = 0; n < group.size(); ++n) {
    const bool is_needed = value_without([n](size_t i) { return i == n; }) != after;
    if (is_needed || value_without([n](size_t i) { return i != n; }) == after) return n;
  }
  return 0;
}

bool LeafSolver::first_change(CellKind kind, const Leaf& leaf, std::span<const LiteralOnRay> on_ray,
                              const LocalRay& ray, double t0, double t1, Inside& inside,
                              Change& change) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  list_crossings(on_ray, t0, t1);
  start(kind, leaf, literals);
  bool solid = value(kind, leaf, literals);
  if (inside != Inside::kUnknown && solid != (inside == Inside::kYes)) {
    // The literal whose surface is nearest brought us here.
    uint32_t nearest = 0;
    const auto distance = [&](uint32_t i) {
      return std::fabs(K::along_value(on_ray[i].along, t0));
    };
    for (uint32_t i = 1; i < on_ray.size(); ++i)
      if (distance(i) < distance(nearest)) nearest = i;
    ++disagreements;
    const Crossing here{t0, nearest};
    change = describe(leaf, literals, ray, t0, {&here, 1}, solid);
    return true;
  }
  for (size_t i = 0; i < crossings_.size();) {
    const size_t first = i;
    const double t = crossings_[i].t;
    // The first one in any case: where numbers overflow, t may be none.
    do flip(kind, literals, crossings_[i].literal);
    while (++i < crossings_.size() && crossings_[i].t <= t + together_);
    const bool after = value(kind, leaf, literals);
    if (after == solid) continue;
    const std::span<Crossing> group(&crossings_[first], i - first);
    std::ranges::sort(group, {}, &Crossing::literal);  // the order of the file
    std::swap(group[0], group[decisive(kind, leaf, literals, group)]);
    change = describe(leaf, literals, ray, t, group, after);
    return true;
  }
  inside = solid ? Inside::kYes : Inside::kNo;
  return false;
}

Change LeafSolver::describe(const Leaf& leaf, std::span<const LeafLiteral> literals,
                            const LocalRay& ray, double t, std::span<const Crossing> group,
                            bool solid_after) const {
  const Vec3 point = ray.origin + ray.direction * t;
  uint32_t literal = group[0].literal;
  uint32_t id = literals[literal].owner;
  if (id == kSharedOwner || (group.size() > 1 && leaf.token_count > 0)) {
    const Face& face = owner(leaf, literals, point, group);
    id = scene_.units[face.unit].id;
    for (const Crossing& crossing : group)
      if (literals[crossing.literal].literal >> 1 == face.literal >> 1) literal = crossing.literal;
  }
  // Out of the half-space is out of the solid too if both were entered or both left.
  return {t, id, literals[literal].literal >> 1, bool(is_inside_[literal]) != solid_after};
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
  const auto changes = [&](size_t at, size_t size) {
    const uint8_t both = evaluate<uint8_t>(formula.subspan(at, size), 3, value);
    return both == 1 || both == 2;
  };
  // Down the tree, at each group into the first operand that changes.
  size_t at = 0;
  while (formula[at].is_group()) {
    if (formula[at].is_pass()) {
      ++at;
      continue;
    }
    const size_t end = at + formula[at].payload();
    size_t operand = at + 1, chosen = end;
    while (operand < end) {
      if (formula[operand].is_pass()) {
        ++operand;
        continue;
      }
      const size_t size = formula[operand].is_group() ? formula[operand].payload() : 1;
      if (changes(operand, size)) {
        chosen = operand;
        break;
      }
      operand += size;
    }
    if (chosen == end) {
      // No operand changes here: the neighbouring cell did not see this change, so its half-space
      // was on the other side of rounding. The first face on that half-space has it.
      const uint32_t half_space = literals[group[0].literal].literal >> 1;
      for (at = 0; at + 1 < formula.size(); ++at)
        if (!formula[at].is_group() &&
            scene_.faces[formula[at].payload()].literal >> 1 == half_space)
          break;
      break;
    }
    at = chosen;
  }
  return scene_.faces[formula[at].payload()];
}

}  // namespace whittle

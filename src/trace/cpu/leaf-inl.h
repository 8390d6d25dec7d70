// Solves one leaf along the rays of a packet. Included once for every instruction set.
#if defined(WHITTLE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHITTLE_LEAF_INL_H
#undef WHITTLE_LEAF_INL_H
#else
#define WHITTLE_LEAF_INL_H
#endif

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include "trace/cpu/half_spaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

static_assert(kKeptLiterals >= kTableLiterals && kKeptLiterals <= 64);

/// Packets that are solved together; more only fill the nearest cache.
constexpr size_t kGroup = kGroupRays / kMaxLanes;

/// Packets that pass a cell, and between which t.
struct Visitors {
  size_t count = 0;
  uint32_t packet[kGroup];
  uint32_t lanes[kGroup];  ///< of the packet, a bit each
  alignas(64) double t0[kGroupRays], t1[kGroupRays];

  /// Without any lanes: nothing.
  HWY_INLINE void add(size_t number, uint32_t passing, Real start, Real end) {
    packet[count] = uint32_t(number);
    lanes[count] = passing;
    hn::Store(start, D(), t0 + count * Tile::lanes());
    hn::Store(end, D(), t1 + count * Tile::lanes());
    count += passing != 0;
  }
};

/// What cells do to rays. Each step is done for all visitors before the next one, so that none
/// waits for another's arithmetic.
class LeavesInLanes {
 public:
  /// With `through` rays meet nothing, but go on; what they cross is added to it.
  LeavesInLanes(const LaneScene& scene, Tile& tile, LaneScratch& scratch,
                std::vector<LaneChange>* through = nullptr)
      : scene_(scene),
        tile_(tile),
        scratch_(scratch),
        half_spaces_(scene, tile),
        through_(through) {}

  Visitors visitors;

  /// Takes the visitors through a cell that is no node. Some may meet something (Tile::hit).
  void pass(CellLink cell);

 private:
  void forget_at_eye();
  void close(size_t visitor, uint32_t lanes, bool solid);
  void solve(CellKind kind, const Leaf& leaf);
  void settle_long(const Leaf& leaf, uint32_t settles, uint32_t settling);
  template <AlongKind kKind, bool kKeeps>
  uint32_t look_at(const LeafLiteral& literal, size_t number, uint32_t settles, uint32_t settling);
  void find_roots(size_t literals);
  /// Which states are in the solid: says a table, or there is but one that is, or that is not, or
  /// says a program.
  enum class Says : uint8_t { kTable, kLoneState, kProgram };
  template <Says kSays>
  HWY_INLINE void solve_all_in_lanes(CellKind kind, const Leaf& leaf) {
    find_roots(leaf.literal_count);
    for (size_t w = 0; w < waiting_count_; ++w)
      open_[waiting_[w]] = solve_in_lanes<kSays>(kind, leaf, waiting_[w]);
  }
  /// Leaves without a table, of which all is kept. By itself, or what is done far more often would
  /// be a twentieth slower.
  HWY_NOINLINE void solve_group(CellKind kind, const Leaf& leaf) {
    solve_all_in_lanes<Says::kLoneState>(kind, leaf);
  }
  HWY_NOINLINE void solve_program(const Leaf& leaf) {
    solve_all_in_lanes<Says::kProgram>(CellKind::kProgram, leaf);
  }
  template <Says kSays>
  uint32_t solve_in_lanes(CellKind kind, const Leaf& leaf, size_t visitor);
  static uint32_t run_program(std::span<const Step> steps, const uint8_t* inside, uint32_t lanes);
  uint32_t find_owners(const Leaf& leaf, size_t packet, uint32_t lanes, Word state,
                       uint32_t literal);
  void solve_kept_lanes(CellKind kind, const Leaf& leaf, size_t visitor);
  void solve_long_lanes(CellKind kind, const Leaf& leaf, size_t visitor);
  template <class SignsOf, class AlongOf>
  void solve_lane(CellKind kind, const Leaf& leaf, size_t visitor, uint32_t lane,
                  const SignsOf& signs_of, const AlongOf& along_of);
  void becomes(size_t packet, uint32_t lanes, uint32_t solid) {
    tile_.known[packet] |= uint8_t(lanes);
    tile_.solid[packet] = uint8_t((tile_.solid[packet] & ~lanes) | (solid & lanes));
  }

  void keep(size_t literal, size_t visitor, const L::AlongRay& f) {
    GroupAlong& to = scratch_.along[literal];
    const size_t at = visitor * Tile::lanes();
    hn::Store(f.a, D(), to.a + at), hn::Store(f.h, D(), to.h + at);
    hn::Store(f.k, D(), to.k + at), hn::Store(f.about, D(), to.about + at);
  }
  L::AlongRay kept(size_t literal, size_t visitor) const {
    const GroupAlong& from = scratch_.along[literal];
    const size_t at = visitor * Tile::lanes();
    return {hn::Load(D(), from.a + at), hn::Load(D(), from.h + at), hn::Load(D(), from.k + at),
            hn::Load(D(), from.about + at)};
  }
  LaneSigns& signs(size_t literal, size_t visitor) {
    return scratch_.signs[literal * kGroup + visitor];
  }

  const LaneScene& scene_;
  Tile& tile_;
  LaneScratch& scratch_;
  const HalfSpacesInLanes half_spaces_;
  std::vector<LaneChange>* const through_;  ///< or none

  /// Crossings of all visitors, those of each one after the other.
  struct Root {
    uint8_t literal, visitor;
    uint8_t lanes, rising;
  };
  // By visitor.
  uint32_t open_[kGroup], quiet_[kGroup], opposite_[kGroup];
  uint32_t waiting_[kGroup];  ///< visitors that are open
  size_t waiting_count_ = 0;
  uint32_t first_root_[kGroup + 1];
  alignas(64) double root_t_[2 * kKeptLiterals * kGroupRays];
  Root roots_[2 * kKeptLiterals * kGroup];
};

inline void LeavesInLanes::pass(CellLink cell) {
  switch (cell.kind()) {
    case CellKind::kIgnored:
      for (size_t i = 0; i < visitors.count; ++i)
        tile_.known[visitors.packet[i]] &= uint8_t(~visitors.lanes[i]);
      return;
    case CellKind::kEmpty:
    case CellKind::kFull:
      for (size_t i = 0; i < visitors.count; ++i) {
        const uint32_t packet = visitors.packet[i], lanes = visitors.lanes[i];
        const uint32_t here = cell.kind() == CellKind::kFull ? lanes : 0;
        // A surface on a cell's side is a literal on both sides of it, so this cannot be a change.
        const uint32_t other = (tile_.solid[packet] ^ here) & tile_.known[packet] & lanes;
        scratch_.stats.disagreements += uint32_t(std::popcount(other));
        if (HWY_UNLIKELY(through_ != nullptr && other != 0)) close(i, other, here != 0);
        becomes(packet, lanes, here);
      }
      return;
    default: {
      const Leaf& leaf = cell.leaf();
      solve(cell.kind(), leaf);
      if (HWY_UNLIKELY(tile_.from_within)) forget_at_eye();
    }
  }
}

/// Rays that came in with the other value than all of the cell has: between it and its neighbour
/// there is a crossing of which neither knows.
HWY_NOINLINE inline void LeavesInLanes::close(size_t visitor, uint32_t lanes, bool solid) {
  const size_t packet = visitors.packet[visitor];
  for (uint32_t left = lanes; left != 0; left &= left - 1) {
    const auto lane = uint32_t(std::countr_zero(left));
    const double t0 = visitors.t0[visitor * Tile::lanes() + lane];
    through_->push_back(
        {uint32_t(packet * Tile::lanes()) + lane, {t0, 0, LaneChange::kNoHalfSpace, false, solid}});
  }
}

/// On a way that ends at the eye, sides are only told by where the ray goes: the next cell knows
/// better.
inline void LeavesInLanes::forget_at_eye() {
  for (size_t i = 0; i < visitors.count; ++i) {
    const size_t packet = visitors.packet[i];
    const Real end = hn::Load(D(), visitors.t1 + i * Tile::lanes());
    tile_.known[packet] &= uint8_t(~(bits(hn::Le(end, tile_.at_eye(packet))) & visitors.lanes[i]));
  }
}

inline void LeavesInLanes::solve(CellKind kind, const Leaf& leaf) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  const bool is_long = literals.size() > kKeptLiterals;
  // In a large model none of them is near, and all are on their way at once.
  for (const LeafLiteral& literal : literals.first(std::min(literals.size(), kKeptLiterals)))
    hwy::Prefetch(&scene_.half_spaces[literal.literal >> 1]);
  const bool conjunction = kind == CellKind::kConjunction,
             disjunction = kind == CellKind::kDisjunction;
  // One literal that is false all along settles a conjunction, one that is true a disjunction;
  // unless the ray came in with the opposite value, which makes it a change.
  const uint32_t settles = conjunction || disjunction ? ~0u : 0, settling = disjunction ? 0 : ~0u;
  for (size_t i = 0; i < visitors.count; ++i) {
    const uint32_t packet = visitors.packet[i];
    open_[i] = quiet_[i] = visitors.lanes[i];
    opposite_[i] = tile_.known[packet] & (tile_.solid[packet] ^ ~settling);
    scratch_.stats.leaves += uint32_t(std::popcount(open_[i]));
  }
  if (HWY_UNLIKELY(is_long)) {
    settle_long(leaf, settles, settling);
  } else {
    uint32_t any_open = ~0u;
    for (size_t literal = 0; literal < literals.size() && any_open != 0; ++literal)
      any_open =
          with_kind(scene_.half_spaces[literals[literal].literal >> 1].kind, [&](auto along_kind) {
            return look_at<along_kind.value, true>(literals[literal], literal, settles, settling);
          });
  }
  if (settles) {
    for (size_t i = 0; i < visitors.count; ++i) {
      const uint32_t packet = visitors.packet[i], settled = visitors.lanes[i] & ~open_[i];
      // What is left without any crossing has the other value.
      const uint32_t same =
          open_[i] & quiet_[i] & ~(tile_.known[packet] & (tile_.solid[packet] ^ settling));
      open_[i] &= ~same;
      becomes(packet, settled | same, (settled & ~settling) | (same & settling));
    }
  }
  waiting_count_ = 0;
  for (size_t i = 0; i < visitors.count; ++i) {
    waiting_[waiting_count_] = uint32_t(i);
    waiting_count_ += open_[i] != 0;
  }
  if (waiting_count_ == 0) return;
  if (scene_.solves_in_lanes && !is_long && through_ == nullptr) {
    if (literals.size() <= kTableLiterals)
      solve_all_in_lanes<Says::kTable>(kind, leaf);
    else if (settles)
      solve_group(kind, leaf);
    else if (leaf.step_count <= kMostSteps)
      solve_program(leaf);
  }
  for (size_t w = 0; w < waiting_count_; ++w) {
    if (open_[waiting_[w]] == 0) continue;
    if (is_long)
      solve_long_lanes(kind, leaf, waiting_[w]);
    else
      solve_kept_lanes(kind, leaf, waiting_[w]);
  }
}

/// Which visitors some literal of a long conjunction or disjunction settles.
HWY_NOINLINE inline void LeavesInLanes::settle_long(const Leaf& leaf, uint32_t settles,
                                                    uint32_t settling) {
  if (!settles) return;
  uint32_t any_open = ~0u;
  const std::span<const LeafLiteral> literals = leaf.literals();
  for (size_t i = 0; i < literals.size() && any_open != 0; ++i) {
    if (i + kKeptLiterals < literals.size())
      hwy::Prefetch(&scene_.half_spaces[literals[i + kKeptLiterals].literal >> 1]);
    any_open = with_kind(scene_.half_spaces[literals[i].literal >> 1].kind, [&](auto along_kind) {
      return look_at<along_kind.value, false>(literals[i], i, settles, settling);
    });
  }
}

/// The signs of one literal for all visitors, kept or not. If `settles`, a lane along which the
/// literal never changes and is not `settling` (all bits, or none) needs no more literals.
/// Returns the lanes that still do, of any visitor.
template <AlongKind kKind, bool kKeeps>
HWY_INLINE uint32_t LeavesInLanes::look_at(const LeafLiteral& literal, size_t number,
                                           uint32_t settles, uint32_t settling) {
  const uint32_t turned = (literal.literal & 1 ? ~0u : 0) ^ settling;
  uint32_t any_open = 0;
  for (size_t i = 0; i < visitors.count; ++i) {
    const size_t packet = visitors.packet[i];
    const Real t0 = hn::Load(D(), visitors.t0 + i * Tile::lanes()),
               t1 = hn::Load(D(), visitors.t1 + i * Tile::lanes());
    const L::AlongRay f = half_spaces_.along<kKind>(literal.literal >> 1, packet);
    const LaneSigns s = half_spaces_.signs_between<kKind>(literal.literal >> 1, packet, f, t0, t1);
    if (kKeeps) {
      keep(number, i, f);
      signs(number, i) = s;
    }
    scratch_.stats.literals += uint32_t(std::popcount(open_[i]));
    const uint32_t still = ~(s.changes() | s.bends());
    quiet_[i] &= still;
    open_[i] &= ~(still & (s.inside() ^ turned) & ~opposite_[i] & settles);
    any_open |= open_[i];
  }
  return any_open;
}

/// All crossings of all visitors, infinitely far where a lane has none.
inline void LeavesInLanes::find_roots(size_t literals) {
  size_t n = 0;
  for (size_t i = 0; i < visitors.count; ++i) {
    first_root_[i] = uint32_t(n);
    if (open_[i] == 0) continue;
    for (size_t literal = 0; literal < literals; ++literal) {
      const LaneSigns& s = signs(literal, i);
      const uint32_t bends = s.bends() & open_[i], crosses = (s.changes() & open_[i]) | bends;
      // f rises where the ray leaves the half-space.
      roots_[n] = {uint8_t(literal), uint8_t(i), uint8_t(crosses), uint8_t(s.inside())};
      n += crosses != 0;
      roots_[n] = {uint8_t(literal), uint8_t(i), uint8_t(bends), uint8_t(~s.inside())};
      n += bends != 0;
    }
  }
  first_root_[visitors.count] = uint32_t(n);
  for (size_t r = 0; r < n; ++r) {
    const Root& root = roots_[r];
    const size_t at = root.visitor * Tile::lanes();
    const L::AlongRay f = kept(root.literal, root.visitor);
    // The signs say that it is in (t0, t1]; rounding may not.
    const Real t =
        hn::Min(hn::Max(L::along_root(f, mask_of(root.rising)), hn::Load(D(), visitors.t0 + at)),
                hn::Load(D(), visitors.t1 + at));
    hn::Store(L::select(mask_of(root.lanes), t, set(kInfinity)), D(), root_t_ + r * Tile::lanes());
  }
}

/// Those of the lanes given for which a program says yes. `inside`: by literal, the lanes that are
/// inside its half-space. All lanes take each step together: where they go from there stands behind
/// it.
HWY_INLINE uint32_t LeavesInLanes::run_program(std::span<const Step> steps, const uint8_t* inside,
                                               uint32_t lanes) {
  // By step, the lanes that come to it; then those that come to the answers.
  uint8_t lanes_at[kMostSteps + 2];
  std::memset(lanes_at, 0, steps.size());
  uint8_t* const answers = lanes_at + kMostSteps;
  answers[0] = answers[1] = 0;
  const auto at = [&](uint32_t step) -> uint8_t& {
    return lanes_at[step < kAnswerFalse ? step : kMostSteps + (step - kAnswerFalse)];
  };
  lanes_at[0] = uint8_t(lanes);
  for (size_t i = 0; i < steps.size(); ++i) {
    const uint32_t here = lanes_at[i];
    if (here == 0) continue;
    const Step& step = steps[i];
    const uint32_t holds = inside[step.literal >> 1] ^ (0u - (step.literal & 1));
    at(step.on_true) |= uint8_t(here & holds);
    at(step.on_false) |= uint8_t(here & ~holds);
  }
  return answers[kAnswerTrue - kAnswerFalse];
}

/// Decides what is plain. Returns the lanes that are not: where crossings coincide, where
/// the leaf disagrees with what is known, where a surface has several owners, and where numbers
/// overflow.
template <LeavesInLanes::Says kSays>
inline uint32_t LeavesInLanes::solve_in_lanes(CellKind kind, const Leaf& leaf, size_t visitor) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  const Real never = set(kInfinity);
  const Word one = hn::Set(Words(), 1), table = hn::Set(Words(), leaf.table);
  const auto as_words = [](Bool mask) { return hn::RebindMask(Words(), mask); };
  const size_t packet = visitors.packet[visitor];
  // One bit a literal: whether the ray is inside its half-space.
  Word state = hn::Zero(Words());
  for (size_t i = 0; i < literals.size(); ++i)
    state = hn::Or(state, hn::IfThenElseZero(as_words(mask_of(signs(i, visitor).inside())),
                                             hn::Set(Words(), uint64_t(1) << i)));
  // In one state only all literals of a conjunction hold, or none of a disjunction.
  const uint32_t otherwise = kind == CellKind::kDisjunction ? ~0u : 0;
  uint64_t lone_state = 0;
  for (size_t i = 0; kSays == Says::kLoneState && i < literals.size(); ++i)
    lone_state |= uint64_t((literals[i].literal ^ otherwise ^ 1) & 1) << i;
  const Word lone = hn::Set(Words(), lone_state);
  // For a program the same by literal: the lanes that are inside.
  uint8_t inside[kKeptLiterals];
  for (size_t i = 0; kSays == Says::kProgram && i < literals.size(); ++i)
    inside[i] = uint8_t(signs(i, visitor).inside());
  uint32_t open = open_[visitor];
  const auto solid_in = [&](Word s) {
    if (kSays == Says::kProgram) return run_program(leaf.steps(), inside, open);
    if (kSays == Says::kLoneState) return bits(hn::RebindMask(D(), hn::Eq(s, lone))) ^ otherwise;
    return bits(hn::RebindMask(D(), hn::Ne(hn::And(hn::Shr(table, s), one), hn::Zero(Words()))));
  };
  const uint32_t solid = solid_in(state);
  uint32_t delicate = open & tile_.known[packet] & (solid ^ tile_.solid[packet]);
  const Root* const roots = &roots_[first_root_[visitor]];
  double* const at = &root_t_[first_root_[visitor] * Tile::lanes()];
  const size_t count = first_root_[visitor + 1] - first_root_[visitor];
  while (true) {
    Real first = never, second = never;
    Word flip = hn::Zero(Words());
    for (size_t i = 0; i < count; ++i) {
      const Real t = hn::Load(D(), at + i * Tile::lanes());
      delicate |= ~bits(t == t);
      const Bool sooner = t < first;
      second = hn::Min(second, L::select(sooner, first, t));
      flip =
          hn::IfThenElse(as_words(sooner), hn::Set(Words(), uint64_t(1) << roots[i].literal), flip);
      first = hn::Min(t, first);
    }
    open &= ~delicate;
    const uint32_t none = open & ~bits(first < never);
    becomes(packet, none, solid);
    open &= ~none;
    if (open == 0) return delicate & open_[visitor];
    delicate |= open & bits(hn::Le(second, first + set(scene_.ray_tolerance)));
    open &= ~delicate;
    state = hn::Xor(state, flip);
    for (size_t i = 0; kSays == Says::kProgram && i < count; ++i)
      inside[roots[i].literal] ^=
          uint8_t(bits(hn::Load(D(), at + i * Tile::lanes()) == first) & open);
    const uint32_t after = solid_in(state), met = open & (after ^ solid);
    if (met != 0) {
      const uint32_t inside_after =
          bits(hn::RebindMask(D(), hn::Ne(hn::And(state, flip), hn::Zero(Words()))));
      const Word turned = hn::IfThenElseZero(as_words(mask_of(inside_after ^ after)), one);
      for (size_t i = 0; i < literals.size(); ++i) {
        const Bool by = hn::RebindMask(D(), hn::Eq(flip, hn::Set(Words(), uint64_t(1) << i)));
        const uint32_t lanes = met & bits(by);
        if (lanes == 0) continue;
        const Word by_owner =
            hn::Set(Words(), what_is_met(literals[i].owner, literals[i].literal >> 1, false));
        tile_.met(packet, lanes, first, hn::Or(by_owner, turned));
        if (literals[i].owner == kSharedOwner)
          delicate |= lanes & ~find_owners(leaf, packet, lanes, state, uint32_t(i));
      }
      open &= ~met;
    }
    if (open == 0) return delicate & open_[visitor];
    for (size_t i = 0; i < count; ++i) {
      const Real t = hn::Load(D(), at + i * Tile::lanes());
      hn::Store(L::select(t == first, never, t), D(), at + i * Tile::lanes());
    }
  }
}

/// Completes what some lanes have met, after the crossing of a literal of several owners. Returns
/// the lanes whose owner is known; the others have met nothing yet.
inline uint32_t LeavesInLanes::find_owners(const Leaf& leaf, size_t packet, uint32_t lanes,
                                           Word state, uint32_t literal) {
  alignas(64) uint64_t states[kMaxLanes];
  hn::Store(state, Words(), states);
  uint32_t found = 0;
  for (uint32_t left = lanes; left != 0; left &= left - 1) {
    const auto lane = uint32_t(std::countr_zero(left));
    const uint32_t id = scratch_.solver.owner_of(leaf, states[lane], literal);
    if (id == kSharedOwner) continue;
    tile_.add_owner(packet, lane, id);
    found |= 1u << lane;
  }
  tile_.hit[packet] &= uint8_t(~(lanes & ~found));
  return found;
}

inline void LeavesInLanes::solve_kept_lanes(CellKind kind, const Leaf& leaf, size_t visitor) {
  for (uint32_t left = open_[visitor]; left != 0; left &= left - 1) {
    const auto lane = uint32_t(std::countr_zero(left));
    const size_t at = visitor * Tile::lanes() + lane;
    solve_lane(
        kind, leaf, visitor, lane, [&](uint32_t i) { return signs(i, visitor); },
        [&](uint32_t i) {
          const GroupAlong& f = scratch_.along[i];
          return Kernels<double>::AlongRay{f.a[at], f.h[at], f.k[at], f.about[at]};
        });
  }
}

HWY_NOINLINE inline void LeavesInLanes::solve_long_lanes(CellKind kind, const Leaf& leaf,
                                                         size_t visitor) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  const size_t packet = visitors.packet[visitor];
  const Real t0 = hn::Load(D(), visitors.t0 + visitor * Tile::lanes()),
             t1 = hn::Load(D(), visitors.t1 + visitor * Tile::lanes());
  const auto with_kind_of = [&](size_t i, const auto& visit) {
    const uint32_t half_space = literals[i].literal >> 1;
    return with_kind(scene_.half_spaces[half_space].kind,
                     [&](auto along_kind) { return visit(along_kind, half_space); });
  };
  scratch_.long_signs.resize(literals.size());
  for (size_t i = 0; i < literals.size(); ++i)
    scratch_.long_signs[i] = with_kind_of(i, [&](auto along_kind, uint32_t half_space) {
      const L::AlongRay f = half_spaces_.along<along_kind.value>(half_space, packet);
      return half_spaces_.signs_between<along_kind.value>(half_space, packet, f, t0, t1);
    });
  for (uint32_t left = open_[visitor]; left != 0; left &= left - 1) {
    const auto lane = uint32_t(std::countr_zero(left));
    solve_lane(
        kind, leaf, visitor, lane, [&](uint32_t i) { return scratch_.long_signs[i]; },
        [&](uint32_t i) {
          const L::AlongRay f = with_kind_of(i, [&](auto along_kind, uint32_t half_space) {
            return half_spaces_.along<along_kind.value>(half_space, packet);
          });
          return Kernels<double>::AlongRay{hn::ExtractLane(f.a, lane), hn::ExtractLane(f.h, lane),
                                           hn::ExtractLane(f.k, lane),
                                           hn::ExtractLane(f.about, lane)};
        });
  }
}

/// One ray by itself. Of each literal are given its signs, and f along this ray where it is needed.
template <class SignsOf, class AlongOf>
inline void LeavesInLanes::solve_lane(CellKind kind, const Leaf& leaf, size_t visitor,
                                      uint32_t lane, const SignsOf& signs_of,
                                      const AlongOf& along_of) {
  const size_t packet = visitors.packet[visitor], at = visitor * Tile::lanes() + lane;
  const double t0 = visitors.t0[at];
  LeafSolver& solver = scratch_.solver;
  solver.take(kind, leaf, t0, visitors.t1[at], [&](uint32_t i) {
    const LaneSigns s = signs_of(i);
    LiteralOnRay on_ray{{},
                        bool(s.inside() >> lane & 1),
                        bool(s.changes() >> lane & 1),
                        bool(s.bends() >> lane & 1)};
    if (on_ray.changes || on_ray.bends) on_ray.along = along_of(i);
    return on_ray;
  });
  const uint32_t bit = 1u << lane;
  Inside inside = !(tile_.known[packet] & bit) ? Inside::kUnknown
                  : tile_.solid[packet] & bit  ? Inside::kYes
                                               : Inside::kNo;
  const LocalRay ray = tile_.ray(packet, lane);
  Change change;
  bool changes = true;
  const bool differs = solver.differs(inside);
  if (HWY_UNLIKELY(differs)) {
    uint32_t nearest = 0;
    double least = kInfinity;
    for (uint32_t i = 0; i < leaf.literal_count; ++i) {
      const double distance = std::fabs(Kernels<double>::along_value(along_of(i), t0));
      if (i == 0 || distance < least) least = distance, nearest = i;
    }
    change = solver.change_at_start(ray, t0, nearest);
  } else {
    changes = solver.next_change(ray, inside, change);
  }
  if (through_ != nullptr) {
    for (; changes; changes = solver.next_change(ray, inside, change))
      through_->push_back({uint32_t(packet * Tile::lanes()) + lane, change});
  }
  if (changes)
    tile_.lane_met(packet, lane, change.t,
                   what_is_met(change.id, change.half_space, change.turned));
  else
    becomes(packet, bit, inside == Inside::kYes ? bit : 0);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#endif

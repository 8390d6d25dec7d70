// Solves one leaf along the rays of a packet. Included once for every instruction set.
#if defined(WHITTLE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHITTLE_LEAF_INL_H
#undef WHITTLE_LEAF_INL_H
#else
#define WHITTLE_LEAF_INL_H
#endif

#include <bit>
#include <cmath>

#include "trace/cpu/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

/// This far ahead a ray from an eye on a surface looks where it goes (a tip has no slope); a share
/// of the region's longest edge.
constexpr double kAhead = 1e-9;

class LeavesInLanes {
 public:
  LeavesInLanes(const LaneScene& scene, Tile& tile, LaneScratch& scratch)
      : scene_(scene), tile_(tile), scratch_(scratch) {
    scratch.in_lanes.resize(std::max<size_t>(scratch.in_lanes.size(), kTableLiterals));
  }

  /// What a cell that is no node does to those `lanes` of a packet that pass it from t0 to t1. Some
  /// of them may meet something (Tile::hit).
  void pass(const Cell& cell, size_t packet, uint32_t lanes, Real t0, Real t1);

 private:
  /// A half-space at one end of the way through a cell.
  struct End {
    Real value;
    Bool inside, falls;
  };
  L::AlongRay along_rays(uint32_t half_space, const LaneHalfSpace& h, const L::Vec3& origin,
                         const L::Vec3& direction) const;
  LaneSigns signs_between(size_t packet, const L::AlongRay& f, bool plane, Real t0, Real t1) const;
  static End end_at(L::AlongRay f, Real t);
  Bool is_at_eye(Real at_eye, Real t, const End& end) const;
  End end_at_eye(Real at_eye, L::AlongRay f, Real t, End end) const;
  void solve(CellKind kind, const Leaf& leaf, size_t packet, uint32_t lanes, Real t0, Real t1);
  uint32_t solve_in_lanes(const Leaf& leaf, std::span<const LeafLiteral> literals, size_t packet,
                          uint32_t open, Real t0, Real t1);
  void solve_lane(CellKind kind, const Leaf& leaf, size_t packet, uint32_t lane, double t0,
                  double t1);
  void becomes(size_t packet, uint32_t lanes, uint32_t solid) {
    tile_.known[packet] |= uint8_t(lanes);
    tile_.solid[packet] = uint8_t((tile_.solid[packet] & ~lanes) | (solid & lanes));
  }

  const LaneScene& scene_;
  Tile& tile_;
  LaneScratch& scratch_;
};

inline void LeavesInLanes::pass(const Cell& cell, size_t packet, uint32_t lanes, Real t0, Real t1) {
  switch (cell.kind) {
    case CellKind::kIgnored:
      tile_.known[packet] &= uint8_t(~lanes);
      return;
    case CellKind::kEmpty:
    case CellKind::kFull: {
      const uint32_t here = cell.kind == CellKind::kFull ? lanes : 0;
      // A surface on a cell's side is a literal on both sides of it, so this cannot be a change.
      scratch_.stats.disagreements +=
          uint32_t(std::popcount((tile_.solid[packet] ^ here) & tile_.known[packet] & lanes));
      becomes(packet, lanes, here);
      return;
    }
    default:
      solve(cell.kind, scene_.tree.leaves[cell.index], packet, lanes, t0, t1);
  }
}

/// f of one half-space along all rays.
HWY_INLINE L::AlongRay LeavesInLanes::along_rays(uint32_t half_space, const LaneHalfSpace& h,
                                                 const L::Vec3& origin,
                                                 const L::Vec3& direction) const {
  const L::Vec3 o = {origin.x - set(h.center.x), origin.y - set(h.center.y),
                     origin.z - set(h.center.z)};
  if (h.kind == AlongKind::kPlane) return L::plane_along_ray(set(h.v), o, direction);
  if (h.kind == AlongKind::kSphere) return L::sphere_along_ray(set(h.v.x), set(h.c), o, direction);
  const auto& q = scene_.scene.half_spaces[half_space].f;
  const L::Quadric f = {set(q.diag), set(q.off), set(q.b), set(q.c)};
  return h.kind == AlongKind::kSmallQuadric ? L::small_quadric_along_ray(f, o, direction)
                                            : L::quadric_along_ray(f, o, direction);
}

/// Where f changes its sign between t0 and t1. Neighbouring cells evaluate the same numbers at
/// the t they share, so each change of sign is found in one of them, and in one only.
HWY_INLINE LaneSigns LeavesInLanes::signs_between(size_t packet, const L::AlongRay& f, bool plane,
                                                  Real t0, Real t1) const {
  End start = end_at(f, t0), end = end_at(f, t1);
  if (HWY_UNLIKELY(tile_.from_within)) {
    const Real at_eye = tile_.at_eye(packet);
    start = end_at_eye(at_eye, f, t0, start);
    end = end_at_eye(at_eye, f, t1, end);
    // A plane through the eye is not crossed again, and one that the ray runs in not at all: its
    // side is that of the way's end.
    const Bool in_plane = hn::And(f.a == set(0), is_at_eye(at_eye, t0, start));
    start.inside = hn::Or(hn::And(in_plane, end.inside), hn::AndNot(in_plane, start.inside));
  }
  LaneSigns signs;
  signs.inside = bits(start.inside);
  signs.changes = signs.inside ^ bits(end.inside);
  if (plane) return signs;
  // In and out again, or out and in: only if f turns back between, and goes beyond zero there.
  const Real bend = L::select(start.inside, set(0) - f.a, f.a);
  const Bool turns = hn::Xor(start.falls, end.falls);
  const Bool bends = hn::And(hn::And(bend > set(0), turns), f.h * f.h > f.a * f.k);
  signs.bends = bits(bends) & ~signs.changes;
  return signs;
}

HWY_INLINE LeavesInLanes::End LeavesInLanes::end_at(L::AlongRay f, Real t) {
  const Real value = L::along_value(f, t);
  return {value, value <= set(0), f.a * (t - f.about) + f.h < set(0)};
}

/// Is this end at the eye, and the eye on the half-space's surface?
HWY_INLINE Bool LeavesInLanes::is_at_eye(Real at_eye, Real t, const End& end) const {
  return hn::And(hn::Le(t, at_eye), hn::Abs(end.value) <= set(kOnSurface * scene_.edge));
}

/// Who stands on a surface has passed it: there the side is that of the way just ahead, and not
/// rounding's. Elsewhere nothing changes.
HWY_INLINE LeavesInLanes::End LeavesInLanes::end_at_eye(Real at_eye, L::AlongRay f, Real t,
                                                        End end) const {
  const Bool on_surface = is_at_eye(at_eye, t, end);
  const Bool falls = f.a * (t - f.about + set(kAhead * scene_.edge)) + f.h < set(0);
  const auto choose = [&](Bool there, Bool else_there) {
    return hn::Or(hn::And(on_surface, there), hn::AndNot(on_surface, else_there));
  };
  return {end.value, choose(falls, end.inside), choose(falls, end.falls)};
}

inline void LeavesInLanes::solve(CellKind kind, const Leaf& leaf, size_t packet, uint32_t lanes,
                                 Real t0, Real t1) {
  const std::span<const LeafLiteral> literals(&scene_.tree.literals[leaf.first_literal],
                                              leaf.literal_count);
  scratch_.stats.leaves += uint32_t(std::popcount(lanes));
  if (literals.size() > scratch_.in_lanes.size()) scratch_.in_lanes.resize(literals.size());
  LiteralInLanes* const in_lanes = scratch_.in_lanes.data();
  const bool conjunction = kind == CellKind::kConjunction,
             disjunction = kind == CellKind::kDisjunction;
  const L::Vec3 origin = tile_.origin(packet), direction = tile_.direction(packet);
  // One literal that is false all along settles a conjunction, one that is true a disjunction;
  // unless the ray came in with the opposite value, which makes it a change.
  const uint32_t known = tile_.known[packet], solid = tile_.solid[packet];
  const uint32_t opposite = known & (conjunction ? solid : ~solid);
  uint32_t open = lanes, quiet = lanes;
  for (size_t i = 0; i < literals.size(); ++i) {
    const uint32_t number = literals[i].literal >> 1;
    const LaneHalfSpace& h = scene_.half_spaces[number];
    const L::AlongRay f = along_rays(number, h, origin, direction);
    const LaneSigns signs = signs_between(packet, f, h.kind == AlongKind::kPlane, t0, t1);
    scratch_.stats.literals += uint32_t(std::popcount(open));
    const uint32_t still = ~(signs.changes | signs.bends);
    const uint32_t is_true = literals[i].literal & 1 ? ~signs.inside : signs.inside;
    if (conjunction) open &= ~(still & ~is_true & ~opposite);
    if (disjunction) open &= ~(still & is_true & ~opposite);
    if (open == 0) break;
    quiet &= still;
    in_lanes[i].signs = signs;
    hn::Store(f.a, D(), in_lanes[i].a);
    hn::Store(f.h, D(), in_lanes[i].h);
    hn::Store(f.k, D(), in_lanes[i].k);
    hn::Store(f.about, D(), in_lanes[i].about);
  }
  becomes(packet, lanes & ~open, disjunction ? ~0u : 0);
  // What is left in a conjunction or disjunction without any crossing has its other value.
  if (conjunction || disjunction) {
    const uint32_t value = conjunction ? ~0u : 0;
    const uint32_t same = open & quiet & ~(known & (solid ^ value));
    becomes(packet, same, value);
    open &= ~same;
  }
  if (open == 0) return;
  if (literals.size() <= kTableLiterals)
    open = solve_in_lanes(leaf, literals, packet, open, t0, t1);
  if (open == 0) return;
  alignas(64) double starts[kMaxLanes], ends[kMaxLanes];
  hn::Store(t0, D(), starts);
  hn::Store(t1, D(), ends);
  for (; open != 0; open &= open - 1) {
    const auto lane = uint32_t(std::countr_zero(open));
    solve_lane(kind, leaf, packet, lane, starts[lane], ends[lane]);
  }
}

/// Decides what is plain, by the leaf's truth table. Returns the lanes that are not: where
/// crossings happen together, where the leaf disagrees with what is known, where a surface has
/// several owners, and where numbers overflow.
inline uint32_t LeavesInLanes::solve_in_lanes(const Leaf& leaf,
                                              std::span<const LeafLiteral> literals, size_t packet,
                                              uint32_t open, Real t0, Real t1) {
  const Word one = hn::Set(Words(), 1), table = hn::Set(Words(), leaf.table);
  const auto as_words = [](Bool mask) { return hn::RebindMask(Words(), mask); };
  const LiteralInLanes* const in_lanes = scratch_.in_lanes.data();
  // One bit a literal: whether the ray is inside its half-space.
  Word state = hn::Zero(Words());
  for (size_t i = 0; i < literals.size(); ++i)
    state = hn::Or(state, hn::IfThenElseZero(as_words(mask_of(in_lanes[i].signs.inside)),
                                             hn::Set(Words(), uint64_t(1) << i)));
  const auto solid_in = [&](Word s) {
    return bits(hn::RebindMask(D(), hn::Ne(hn::And(hn::Shr(table, s), one), hn::Zero(Words()))));
  };
  const uint32_t solid = solid_in(state);
  uint32_t delicate = open & tile_.known[packet] & (solid ^ tile_.solid[packet]);
  open &= ~delicate;

  // Crossings, infinitely far where a lane has none.
  const Real never = set(kInfinity);
  Real at[2 * kTableLiterals];
  uint64_t flips[2 * kTableLiterals];
  size_t count = 0;
  for (size_t i = 0; i < literals.size(); ++i) {
    const LaneSigns& signs = in_lanes[i].signs;
    const uint32_t crosses = (signs.changes | signs.bends) & open;
    if (crosses == 0) continue;
    const L::AlongRay f = {hn::Load(D(), in_lanes[i].a), hn::Load(D(), in_lanes[i].h),
                           hn::Load(D(), in_lanes[i].k), hn::Load(D(), in_lanes[i].about)};
    const auto add = [&](Bool rising, uint32_t lanes) {
      // The signs say that it is in (t0, t1]; rounding may not.
      const Real t = hn::Min(hn::Max(L::along_root(f, rising), t0), t1);
      delicate |= lanes & ~bits(t == t);
      at[count] = L::select(mask_of(lanes), t, never);
      flips[count++] = uint64_t(1) << i;
    };
    // f rises where the ray leaves the half-space.
    const Bool inside = mask_of(signs.inside);
    add(inside, crosses);
    if ((signs.bends & open) != 0) add(hn::Not(inside), signs.bends & open);
  }
  open &= ~delicate;

  while (true) {
    Real first = never, second = never;
    Word flip = hn::Zero(Words());
    for (size_t i = 0; i < count; ++i) {
      const Bool sooner = at[i] < first;
      second = hn::Min(second, L::select(sooner, first, at[i]));
      flip = hn::IfThenElse(as_words(sooner), hn::Set(Words(), flips[i]), flip);
      first = hn::Min(at[i], first);
    }
    const uint32_t none = open & ~bits(first < never);
    becomes(packet, none, solid);
    open &= ~none;
    if (open == 0) return delicate;
    const uint32_t close = open & bits(hn::Le(second, first + set(scene_.together)));
    delicate |= close;
    open &= ~close;
    state = hn::Xor(state, flip);
    const uint32_t after = solid_in(state);
    uint32_t met = open & (after ^ solid);
    if (met != 0) {
      const uint32_t inside_after =
          bits(hn::RebindMask(D(), hn::Ne(hn::And(state, flip), hn::Zero(Words()))));
      const Word turned = hn::IfThenElseZero(as_words(mask_of(inside_after ^ after)), one);
      for (size_t i = 0; i < literals.size(); ++i) {
        const Bool by = hn::RebindMask(D(), hn::Eq(flip, hn::Set(Words(), uint64_t(1) << i)));
        const uint32_t lanes = met & bits(by);
        if (lanes == 0) continue;
        open &= ~lanes;
        if (literals[i].owner == kSharedOwner)
          delicate |= lanes;
        else
          tile_.met(packet, lanes, first,
                    hn::Or(hn::Set(Words(),
                                   what_is_met(literals[i].owner, literals[i].literal >> 1, false)),
                           turned));
      }
      if (open == 0) return delicate;
    }
    for (size_t i = 0; i < count; ++i) at[i] = L::select(at[i] == first, never, at[i]);
  }
}

inline void LeavesInLanes::solve_lane(CellKind kind, const Leaf& leaf, size_t packet, uint32_t lane,
                                      double t0, double t1) {
  scratch_.on_ray.resize(leaf.literal_count);
  for (uint32_t i = 0; i < leaf.literal_count; ++i) {
    const LiteralInLanes& l = scratch_.in_lanes[i];
    scratch_.on_ray[i] = {{l.a[lane], l.h[lane], l.k[lane], l.about[lane]},
                          bool(l.signs.inside >> lane & 1),
                          bool(l.signs.changes >> lane & 1),
                          bool(l.signs.bends >> lane & 1)};
  }
  const uint32_t bit = 1u << lane;
  Inside inside = !(tile_.known[packet] & bit) ? Inside::kUnknown
                  : tile_.solid[packet] & bit  ? Inside::kYes
                                               : Inside::kNo;
  Change change;
  if (scratch_.solver.first_change(kind, leaf, scratch_.on_ray, tile_.ray(packet, lane), t0, t1,
                                   inside, change))
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

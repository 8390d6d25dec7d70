#include "trace/cpu/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/cpu/lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// What the shared arithmetic means in lanes: a Real is a vector of doubles, a Bool a mask.
struct LaneKernels {
  using D = hn::CappedTag<double, 8>;
  using Real = hn::Vec<D>;
  using Bool = hn::Mask<D>;
  struct Vec3 {
    Real x, y, z;
  };
  struct Vec2 {
    Real x, y;
  };

  static HWY_INLINE Real select(Bool condition, Real yes, Real no) {
    return hn::IfThenElse(condition, yes, no);
  }
  static HWY_INLINE Real pmin(Real a, Real b) { return select(b < a, b, a); }
  static HWY_INLINE Real pmax(Real a, Real b) { return select(a < b, b, a); }
  static HWY_INLINE Real fabs_(Real a) { return hn::Abs(a); }
  static HWY_INLINE Real sqrt(Real a) { return hn::Sqrt(a); }
  static HWY_INLINE Real dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static HWY_INLINE Vec3 make_vec3(Real x, Real y, Real z) { return {x, y, z}; }
  static HWY_INLINE Vec2 make_vec2(Real x, Real y) { return {x, y}; }

#define FN static HWY_INLINE
#define K(x) hn::Set(D(), double(x))
#include "kernels/camera.inl"
#include "kernels/halfspace.inl"
#undef K
#undef FN
};

using L = LaneKernels;
using D = L::D;
using Real = L::Real;
using Bool = L::Bool;

HWY_INLINE Real set(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE L::Vec3 set(Vec3 v) {
  return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE uint32_t bits(Bool mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}
HWY_INLINE Bool mask_of(uint32_t lanes) {
  const uint8_t bytes[8] = {uint8_t(lanes)};
  return hn::LoadMaskBits(D(), bytes);
}

constexpr size_t kMaxLanes = 8;

/// Curved surfaces whose radius is below this share of the region's longest edge get the arithmetic
/// for small ones. Without it a surface is blurred by its share's inverse times what rounding does
/// to the region.
constexpr double kSmall = 1.0 / 64;

/// An eye this close to a surface stands on it, this close to the eye a ray still does, and this
/// far ahead it looks where it goes (a tip has no slope); shares of the region's longest edge,
/// above what rounding does.
constexpr double kOnSurface = 2e-14;
constexpr double kAtEye = 1e-13;
constexpr double kAhead = 1e-9;

/// One packet of rays on its way through the cells. A lane takes part in a cell if its interval is
/// not empty there (t0 <= t1), so that intervals alone say which lanes are where.
class Packet {
 public:
  Packet(const Scene& scene, const CellTree& tree, const Camera& camera, LaneScratch& scratch)
      : scene_(scene),
        tree_(tree),
        camera_(camera),
        scratch_(scratch),
        edge_(max_component(scene.region.size())) {}

  /// At most as many positions as there are lanes.
  void trace(std::span<const PixelPosition> positions, std::span<Hit> hits) {
    count_ = positions.size();
    hits_ = hits;
    scratch_.stats.rays += count_;
    std::fill(hits.begin(), hits.end(), Hit{});
    make_rays(positions);
    Real t0 = set(start_t0_), t1 = set(kInfinity);
    t0 = hn::Sub(t0, shift_);
    const Real start = t0;
    at_eye_ = start + set(kAtEye * edge_);
    for (int axis = 0; axis < 3; ++axis) clip(axis, t0, t1);
    const uint32_t all = (1u << count_) - 1;
    const uint32_t meets = bits(hn::Le(t0, t1)) & all;
    // Outside the region of a bounded solid there is nothing; a ray that starts inside of it, or an
    // unbounded solid, tells only at its first cell.
    known_ = scene_.bounded ? bits(hn::Gt(t0, start)) : 0;
    solid_ = 0;

    // Rays that turn different sides to the cells meet them in different order.
    uint32_t left = meets;
    while (left != 0) {
      const int first = std::countr_zero(left);
      uint32_t together = left;
      for (int axis = 0; axis < 3; ++axis) {
        const uint32_t same_side =
            backward_[axis] >> first & 1 ? backward_[axis] : ~backward_[axis];
        together &= same_side;
      }
      left &= ~together;
      walk(together, t0, t1);
    }
  }

 private:
  struct Later {
    double t0[kMaxLanes], t1[kMaxLanes];
    const Cell* cell;
  };

  void make_rays(std::span<const PixelPosition> positions) {
    HWY_ALIGN double x[kMaxLanes], y[kMaxLanes];
    const double scale = camera_.units_per_pixel();
    for (size_t i = 0; i < hn::Lanes(D()); ++i) {
      const PixelPosition& p = positions[std::min(i, count_ - 1)];
      x[i] = (double(p.x) - 0.5 * camera_.width) * scale;
      y[i] = (0.5 * camera_.height - double(p.y)) * scale;
    }
    const Real px = hn::Load(D(), x), py = hn::Load(D(), y);
    const bool ortho = camera_.orthographic;
    const L::Vec3 base = set(ortho ? camera_.eye : camera_.forward);
    const L::Vec3 point = L::picture_point(base, set(camera_.right), set(camera_.up), px, py);
    direction_ = ortho ? set(camera_.forward) : L::unit3(point);
    L::Vec3 from = ortho ? point : set(camera_.eye);
    start_t0_ = ortho ? -camera_.ortho_reach : 0;
    from = {from.x - set(scene_.origin.x), from.y - set(scene_.origin.y),
            from.z - set(scene_.origin.z)};
    // Start next to the solid's middle: far eyes would eat the digits.
    shift_ = set(0) - L::dot3(from, direction_);
    origin_ = {from.x + direction_.x * shift_, from.y + direction_.y * shift_,
               from.z + direction_.z * shift_};
    const Real* d[3] = {&direction_.x, &direction_.y, &direction_.z};
    for (int axis = 0; axis < 3; ++axis) {
      // Either zero has the positive infinity as inverse: the ray stays on its side of a split.
      inverse_[axis] = L::select(*d[axis] == set(0), set(kInfinity), set(1) / *d[axis]);
      backward_[axis] = bits(*d[axis] < set(0));
    }
  }

  Real origin(int axis) const { return axis == 0 ? origin_.x : axis == 1 ? origin_.y : origin_.z; }

  void clip(int axis, Real& t0, Real& t1) const {
    const Real a = (set(tree_.region.lo[axis]) - origin(axis)) * inverse_[axis];
    const Real b = (set(tree_.region.hi[axis]) - origin(axis)) * inverse_[axis];
    t0 = L::pmax(t0, L::pmin(a, b));
    t1 = L::pmin(t1, L::pmax(a, b));
  }

  /// Front to back through the cells; neighbours share the split's exact t.
  void walk(uint32_t lanes, Real t0, Real t1) {
    Later later[kMostDepth];
    uint32_t waiting = 0;
    const Cell* at = tree_.root;
    const int first = std::countr_zero(lanes);
    const uint32_t side[3] = {backward_[0] >> first & 1, backward_[1] >> first & 1,
                              backward_[2] >> first & 1};
    const Real never = set(kInfinity);
    live_ = lanes;
    t0 = L::select(mask_of(lanes), t0, never);
    while (true) {
      CellLink cell = at->link();
      if (cell.kind() == CellKind::kOpen) cell = scratch_.refiner->refined(*at);
      const Bool active = hn::Le(t0, t1);
      scratch_.stats.cells += hn::CountTrue(D(), active);
      if (cell.kind() == CellKind::kNode) {
        const int axis = cell.axis();
        const Real t = (set(at->split) - origin(axis)) * inverse_[axis];
        // A ray that runs in the split itself has a NaN here, and either side will do: the near.
        const Bool before_end = t < t1;
        const Bool after_start = hn::Gt(t, t0);
        const Bool wants_far = hn::And(active, before_end);
        const Bool wants_near = hn::And(active, hn::Or(after_start, hn::Not(before_end)));
        const Cell* const near_cell = cell.children() + side[axis];
        const Cell* const far_cell = cell.children() + 1 - side[axis];
        if (hn::AllFalse(D(), wants_far)) {
          at = near_cell;
        } else if (hn::AllFalse(D(), wants_near)) {
          at = far_cell;
        } else {
          Later& far_later = later[waiting++];
          far_later.cell = far_cell;
          hn::StoreU(L::select(wants_far, L::select(after_start, t, t0), never), D(), far_later.t0);
          hn::StoreU(t1, D(), far_later.t1);
          at = near_cell;
          t0 = L::select(wants_near, t0, never);
          t1 = L::select(before_end, t, t1);
        }
        continue;
      }
      leaf(cell, bits(active), t0, t1);
      // The next cell that some ray still needs.
      while (true) {
        if (waiting == 0 || live_ == 0) return;
        const Later& next = later[--waiting];
        t1 = hn::LoadU(D(), next.t1);
        t0 = L::select(mask_of(live_), hn::LoadU(D(), next.t0), never);
        at = next.cell;
        if (!hn::AllFalse(D(), hn::Le(t0, t1))) break;
      }
    }
  }

  void leaf(CellLink cell, uint32_t lanes, Real t0, Real t1) {
    switch (cell.kind()) {
      case CellKind::kIgnored:
        known_ &= ~lanes;
        return;
      case CellKind::kEmpty:
      case CellKind::kFull: {
        const uint32_t here = cell.kind() == CellKind::kFull ? lanes : 0;
        // A surface on a cell's side is a literal on both sides of it, so this cannot be a change.
        scratch_.stats.disagreements += uint32_t(std::popcount((solid_ ^ here) & known_ & lanes));
        known_ |= lanes;
        solid_ = (solid_ & ~lanes) | here;
        return;
      }
      default:
        solve(cell.kind(), cell.leaf(), lanes, t0, t1);
    }
  }

  /// f of one half-space along all rays.
  L::AlongRay along_rays(const HalfSpace& h) const {
    const L::Vec3 o = {origin_.x - set(h.center.x), origin_.y - set(h.center.y),
                       origin_.z - set(h.center.z)};
    if (h.is_plane()) return L::plane_along_ray(set(h.f.b), o, direction_);
    // As f is scaled, 2 |c| is the radius, or the least one.
    const bool small = 2 * std::fabs(h.f.c) < kSmall * edge_;
    if (h.kind == SurfaceKind::kSphere && !small)
      return L::sphere_along_ray(set(h.f.diag.x), set(h.f.c), o, direction_);
    const L::Quadric f = {set(h.f.diag), set(h.f.off), set(h.f.b), set(h.f.c)};
    return small ? L::small_quadric_along_ray(f, o, direction_)
                 : L::quadric_along_ray(f, o, direction_);
  }

  /// Where f changes its sign between t0 and t1. Neighbouring cells evaluate the same numbers at
  /// the t they share, so each change of sign is found in one of them, and in one only.
  LaneSigns signs_between(L::AlongRay f, Real t0, Real t1) const {
    LaneEnd start = end_at(f, t0), end = end_at(f, t1);
    if (!hn::AllFalse(D(), hn::Le(t0, at_eye_))) {
      start = end_at_eye(f, t0, start);
      end = end_at_eye(f, t1, end);
      // A plane through the eye is not crossed again, and one that the ray runs in not at all: its
      // side is that of the way's end.
      const Bool in_plane = hn::And(f.a == set(0), is_at_eye(t0, start));
      start.inside = hn::Or(hn::And(in_plane, end.inside), hn::AndNot(in_plane, start.inside));
    }
    // In and out again, or out and in: only if f turns back between, and goes beyond zero there.
    const Real bend = L::select(start.inside, set(0) - f.a, f.a);
    const Bool turns = hn::Xor(start.falls, end.falls);
    const Bool bends = hn::And(hn::And(bend > set(0), turns), f.h * f.h > f.a * f.k);
    LaneSigns signs;
    signs.inside = bits(start.inside);
    signs.changes = signs.inside ^ bits(end.inside);
    signs.bends = bits(bends) & ~signs.changes;
    return signs;
  }

  /// A half-space at one end of the way through a cell.
  struct LaneEnd {
    Real value;
    Bool inside, falls;
  };
  static LaneEnd end_at(L::AlongRay f, Real t) {
    const Real value = L::along_value(f, t);
    return {value, value <= set(0), f.a * (t - f.about) + f.h < set(0)};
  }

  /// Is this end at the eye, and the eye on the half-space's surface?
  Bool is_at_eye(Real t, const LaneEnd& end) const {
    return hn::And(hn::Le(t, at_eye_), hn::Abs(end.value) <= set(kOnSurface * edge_));
  }

  /// Who stands on a surface has passed it: there the side is that of the way just ahead, and not
  /// rounding's. Elsewhere nothing changes.
  LaneEnd end_at_eye(L::AlongRay f, Real t, LaneEnd end) const {
    const Bool on_surface = is_at_eye(t, end);
    const Bool falls = f.a * (t - f.about + set(kAhead * edge_)) + f.h < set(0);
    const auto choose = [&](Bool there, Bool else_there) {
      return hn::Or(hn::And(on_surface, there), hn::AndNot(on_surface, else_there));
    };
    return {end.value, choose(falls, end.inside), choose(falls, end.falls)};
  }

  void solve(CellKind kind, const Leaf& leaf, uint32_t lanes, Real t0, Real t1) {
    constexpr size_t kLanes = hn::MaxLanes(D());
    const std::span<const LeafLiteral> literals = leaf.literals();
    scratch_.stats.leaves += uint32_t(std::popcount(lanes));
    scratch_.along.resize(std::max(scratch_.along.size(), literals.size() * 4 * kLanes));
    scratch_.signs.resize(std::max(scratch_.signs.size(), literals.size()));
    const bool conjunction = kind == CellKind::kConjunction,
               disjunction = kind == CellKind::kDisjunction;
    // One literal that is false all along settles a conjunction, one that is true a disjunction;
    // unless the ray came in with the opposite value, which makes it a change.
    const uint32_t opposite = known_ & (conjunction ? solid_ : ~solid_);
    uint32_t open = lanes, quiet = lanes;
    for (uint32_t i = 0; i < literals.size(); ++i) {
      const L::AlongRay f = along_rays(scene_.half_spaces[literals[i].literal >> 1]);
      const LaneSigns signs = signs_between(f, t0, t1);
      scratch_.stats.literals += uint32_t(std::popcount(open));
      const uint32_t still = ~(signs.changes | signs.bends);
      const uint32_t is_true = literals[i].literal & 1 ? ~signs.inside : signs.inside;
      if (conjunction) open &= ~(still & ~is_true & ~opposite);
      if (disjunction) open &= ~(still & is_true & ~opposite);
      if (open == 0) break;
      quiet &= still;
      scratch_.signs[i] = signs;
      double* along = &scratch_.along[size_t(i) * 4 * kLanes];
      hn::StoreU(f.a, D(), along);
      hn::StoreU(f.h, D(), along + kLanes);
      hn::StoreU(f.k, D(), along + 2 * kLanes);
      hn::StoreU(f.about, D(), along + 3 * kLanes);
    }
    const uint32_t settled = lanes & ~open;
    known_ |= settled;
    solid_ = (solid_ & ~settled) | (disjunction ? settled : 0);

    // What is left in a conjunction or disjunction without any crossing has its other value.
    if (conjunction || disjunction) {
      const uint32_t value = conjunction ? ~0u : 0;
      const uint32_t same = open & quiet & ~(known_ & (solid_ ^ value));
      known_ |= same;
      solid_ = (solid_ & ~same) | (value & same);
      open &= ~same;
    }
    if (open == 0) return;
    HWY_ALIGN double starts[kLanes], ends[kLanes];
    hn::Store(t0, D(), starts);
    hn::Store(t1, D(), ends);
    for (; open != 0; open &= open - 1)
      solve_lane(kind, leaf, std::countr_zero(open), starts, ends);
  }

  void solve_lane(CellKind kind, const Leaf& leaf, int lane, const double* starts,
                  const double* ends) {
    constexpr size_t kLanes = hn::MaxLanes(D());
    scratch_.on_ray.resize(leaf.literal_count);
    for (uint32_t i = 0; i < leaf.literal_count; ++i) {
      const double* along = &scratch_.along[size_t(i) * 4 * kLanes + size_t(lane)];
      const LaneSigns& signs = scratch_.signs[i];
      scratch_.on_ray[i] = {{along[0], along[kLanes], along[2 * kLanes], along[3 * kLanes]},
                            bool(signs.inside >> lane & 1),
                            bool(signs.changes >> lane & 1),
                            bool(signs.bends >> lane & 1)};
    }
    const uint32_t bit = 1u << lane;
    Inside inside = !(known_ & bit) ? Inside::kUnknown : solid_ & bit ? Inside::kYes : Inside::kNo;
    Change change;
    const LocalRay ray{of_lane(origin_, lane), of_lane(direction_, lane)};
    if (!scratch_.solver.first_change(kind, leaf, scratch_.on_ray, ray, starts[lane], ends[lane],
                                      inside, change)) {
      known_ |= bit;
      solid_ = inside == Inside::kYes ? solid_ | bit : solid_ & ~bit;
      return;
    }
    HWY_ALIGN double shifts[kLanes];
    hn::Store(shift_, D(), shifts);
    const Vec3& n = change.normal;
    hits_[size_t(lane)] = {
        float(change.t + shifts[lane]), change.id, {float(n.x), float(n.y), float(n.z)}};
    live_ &= ~bit;
  }

  static Vec3 of_lane(const L::Vec3& v, int lane) {
    HWY_ALIGN double x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];
    hn::Store(v.x, D(), x);
    hn::Store(v.y, D(), y);
    hn::Store(v.z, D(), z);
    return {x[lane], y[lane], z[lane]};
  }

  const Scene& scene_;
  const CellTree& tree_;
  const Camera& camera_;
  LaneScratch& scratch_;
  double edge_;  ///< the longest of the region

  size_t count_ = 0;
  std::span<Hit> hits_;
  L::Vec3 origin_, direction_;  ///< local; the origin is the point nearest to the region's middle
  Real at_eye_;                 ///< up to this t a ray is where the eye is
  Real shift_;                  ///< t at the camera's start minus t here
  Real inverse_[3];             ///< of the direction
  double start_t0_ = 0;
  uint32_t backward_[3] = {};  ///< lanes whose direction is negative
  uint32_t live_ = 0;          ///< lanes without a hit yet
  uint32_t known_ = 0;         ///< lanes that know whether they are in the solid
  uint32_t solid_ = 0;         ///< and those that are
};

void trace_positions(const Scene& scene, const CellTree& cells, const Camera& camera,
                     std::span<const PixelPosition> positions, std::span<Hit> hits,
                     LaneScratch& scratch) {
  Packet packet(scene, cells, camera, scratch);
  const size_t lanes = hn::Lanes(D());
  for (size_t i = 0; i < positions.size(); i += lanes) {
    const size_t n = std::min(lanes, positions.size() - i);
    packet.trace(positions.subspan(i, n), hits.subspan(i, n));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {

HWY_EXPORT(trace_positions);

void trace_lanes(const Scene& scene, const CellTree& cells, const Camera& camera,
                 std::span<const PixelPosition> positions, std::span<Hit> hits,
                 LaneScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(trace_positions)(scene, cells, camera, positions, hits, scratch);
}

}  // namespace whittle
#endif

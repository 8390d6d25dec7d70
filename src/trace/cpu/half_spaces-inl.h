// Half-spaces along the rays of a packet: f, and its signs on the way through a cell. Included once
// for every instruction set.
#if defined(WHITTLE_HALF_SPACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHITTLE_HALF_SPACES_INL_H
#undef WHITTLE_HALF_SPACES_INL_H
#else
#define WHITTLE_HALF_SPACES_INL_H
#endif

#include <type_traits>

#include "trace/cpu/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

/// Calls `visit` with the kind of a half-space as a constant.
template <class Visit>
HWY_INLINE auto with_kind(AlongKind kind, const Visit& visit) {
  switch (kind) {
    case AlongKind::kPlane:
      return visit(std::integral_constant<AlongKind, AlongKind::kPlane>());
    case AlongKind::kSphere:
      return visit(std::integral_constant<AlongKind, AlongKind::kSphere>());
    case AlongKind::kSmallSphere:
      return visit(std::integral_constant<AlongKind, AlongKind::kSmallSphere>());
    case AlongKind::kDiagonal:
      return visit(std::integral_constant<AlongKind, AlongKind::kDiagonal>());
    case AlongKind::kQuadric:
      return visit(std::integral_constant<AlongKind, AlongKind::kQuadric>());
    case AlongKind::kSmallQuadric:
      return visit(std::integral_constant<AlongKind, AlongKind::kSmallQuadric>());
    case AlongKind::kCone:
      return visit(std::integral_constant<AlongKind, AlongKind::kCone>());
    default:
      return visit(std::integral_constant<AlongKind, AlongKind::kSmallCone>());
  }
}

class HalfSpacesInLanes {
 public:
  HalfSpacesInLanes(const LaneScene& scene, const Tile& tile) : scene_(scene), tile_(tile) {}

  /// f of one half-space along all rays of a packet.
  template <AlongKind kKind>
  L::AlongRay along(uint32_t half_space, size_t packet) const;

  /// Where f changes its sign between t0 and t1. Neighbouring cells evaluate the same numbers at
  /// the t they share, so each change of sign is found in one of them, and in one only.
  template <AlongKind kKind>
  LaneSigns signs_between(uint32_t half_space, size_t packet, const L::AlongRay& f, Real t0,
                          Real t1) const;

 private:
  /// A half-space at one end of the way through a cell.
  struct End {
    Real value;
    Bool inside, falls;
  };
  template <AlongKind kKind>
  static End end_at(L::AlongRay f, Real t);
  /// The eye's neighbourhood: in t, in f, and how far ahead a ray looks where it goes.
  struct AtEye {
    Real t, value, ahead;
  };
  template <AlongKind kKind>
  AtEye at_eye(uint32_t half_space, size_t packet) const;
  Bool is_at_eye(const AtEye& eye, Real t, const End& end) const;
  struct Ends {
    End start, end;
  };
  /// Not in the way of rays that come from outside.
  template <AlongKind kKind>
  HWY_NOINLINE Ends ends_at_eye(uint32_t half_space, size_t packet, L::AlongRay f, Real t0, Real t1,
                                Ends ends) const;
  End end_at_eye(const AtEye& eye, L::AlongRay f, Real t, End end) const;

  const LaneScene& scene_;
  const Tile& tile_;
};

template <AlongKind kKind>
HWY_INLINE L::AlongRay HalfSpacesInLanes::along(uint32_t half_space, size_t packet) const {
  const LaneHalfSpace& h = scene_.half_spaces[half_space];
  const L::Vec3 origin = tile_.origin(packet), d = tile_.direction(packet);
  const L::Vec3 o = {origin.x - set(h.center.x), origin.y - set(h.center.y),
                     origin.z - set(h.center.z)};
  if (kKind == AlongKind::kPlane) return L::plane_along_ray(set(h.v), o, d);
  if (kKind == AlongKind::kSphere) return L::sphere_along_ray(set(h.v.x), set(h.c), o, d);
  if (kKind == AlongKind::kSmallSphere)
    return L::small_sphere_along_ray(set(h.v.x), set(h.c), o, d);
  if (kKind == AlongKind::kDiagonal) return L::diagonal_along_ray(set(h.v), set(h.c), o, d);
  const auto& q = scene_.scene.half_spaces[half_space].f;
  const Vec3 b = is_cone(kKind) ? Vec3{} : q.b;
  const L::Quadric f = {set(q.diag), set(q.off), set(b), set(is_cone(kKind) ? 0 : q.c)};
  if (kKind == AlongKind::kCone) return L::cone_along_ray(f, o, d);
  return kKind == AlongKind::kQuadric ? L::quadric_along_ray(f, o, d)
                                      : L::small_quadric_along_ray(f, o, d);
}

template <AlongKind kKind>
HWY_INLINE LaneSigns HalfSpacesInLanes::signs_between(uint32_t half_space, size_t packet,
                                                      const L::AlongRay& f, Real t0,
                                                      Real t1) const {
  End start = end_at<kKind>(f, t0), end = end_at<kKind>(f, t1);
  if (HWY_UNLIKELY(tile_.from_within)) {
    const Ends ends = ends_at_eye<kKind>(half_space, packet, f, t0, t1, {start, end});
    start = ends.start, end = ends.end;
  }
  const uint32_t inside = bits(start.inside), changes = inside ^ bits(end.inside);
  if (kKind == AlongKind::kPlane) return {inside, changes, 0};
  // In and out again, or out and in: only if f turns back between, and goes beyond zero there.
  const Real bend = L::select(start.inside, set(0) - f.a, f.a);
  const Bool turns = hn::Xor(start.falls, end.falls);
  const Bool bends = hn::And(hn::And(bend > set(0), turns), f.h * f.h > f.a * f.k);
  return {inside, changes, bits(bends) & ~changes};
}

template <AlongKind kKind>
HWY_INLINE HalfSpacesInLanes::End HalfSpacesInLanes::end_at(L::AlongRay f, Real t) {
  if (kKind == AlongKind::kPlane) {
    const Real value = L::plane_value(f, t);
    return {value, value <= set(0), f.h < set(0)};
  }
  const Real value = L::along_value(f, t);
  return {value, value <= set(0), f.a * (t - f.about) + f.h < set(0)};
}

/// f is about a distance. But near the tip of a cone it has no slope, and what is ahead of the eye
/// is as near as the tip.
template <AlongKind kKind>
HWY_INLINE HalfSpacesInLanes::AtEye HalfSpacesInLanes::at_eye(uint32_t half_space,
                                                              size_t packet) const {
  const Real least = set(kOnSurface * scene_.edge), most = set(kAhead * scene_.edge);
  if (!is_cone(kKind)) return {tile_.at_eye(packet), least, most};
  const Vec3 tip = scene_.half_spaces[half_space].center;
  const L::Vec3 o = tile_.origin(packet), d = tile_.direction(packet);
  const Real t = tile_.start(packet);
  const L::Vec3 q = {o.x + d.x * t - set(tip.x), o.y + d.y * t - set(tip.y),
                     o.z + d.z * t - set(tip.z)};
  const auto& f = scene_.scene.half_spaces[half_space].f;
  const Vec3 none;
  const Real distance = L::sqrt(L::dot3(q, q));
  const Real slope =
      L::cone_most_slope({set(f.diag), set(f.off), set(none), set(0)}, distance + least);
  const Real ahead = L::select(distance > least, hn::Min(set(kAhead) * distance, most), most);
  return {tile_.at_eye(packet), least * hn::Min(slope, set(1)), ahead};
}

template <AlongKind kKind>
HWY_NOINLINE HalfSpacesInLanes::Ends HalfSpacesInLanes::ends_at_eye(uint32_t half_space,
                                                                    size_t packet, L::AlongRay f,
                                                                    Real t0, Real t1,
                                                                    Ends ends) const {
  const AtEye eye = at_eye<kKind>(half_space, packet);
  ends = {end_at_eye(eye, f, t0, ends.start), end_at_eye(eye, f, t1, ends.end)};
  // A plane through the eye is not crossed again, and one that the ray runs in not at all: its
  // side is that of the way's end.
  const Bool in_plane = hn::And(f.a == set(0), is_at_eye(eye, t0, ends.start));
  ends.start.inside =
      hn::Or(hn::And(in_plane, ends.end.inside), hn::AndNot(in_plane, ends.start.inside));
  return ends;
}

/// Is this end at the eye, and the eye on the half-space's surface?
HWY_INLINE Bool HalfSpacesInLanes::is_at_eye(const AtEye& eye, Real t, const End& end) const {
  return hn::And(hn::Le(t, eye.t), hn::Abs(end.value) <= eye.value);
}

/// Who stands on a surface has passed it: there the side is that of the way just ahead, and not
/// rounding's. Elsewhere nothing changes.
HWY_INLINE HalfSpacesInLanes::End HalfSpacesInLanes::end_at_eye(const AtEye& eye, L::AlongRay f,
                                                                Real t, End end) const {
  const Bool on_surface = is_at_eye(eye, t, end);
  const Bool falls = f.a * (t - f.about + eye.ahead) + f.h < set(0);
  const auto choose = [&](Bool there, Bool else_there) {
    return hn::Or(hn::And(on_surface, there), hn::AndNot(on_surface, else_there));
  };
  return {end.value, choose(falls, end.inside), choose(falls, end.falls)};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#endif

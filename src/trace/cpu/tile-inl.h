// A tile of rays in lanes: from picture positions to rays, and from what they met to hits. Included
// once for every instruction set.
#if defined(WHITTLE_TILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHITTLE_TILE_INL_H
#undef WHITTLE_TILE_INL_H
#else
#define WHITTLE_TILE_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

#include "trace/cpu/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

/// No inverse of a direction is larger, so that a product with it is a number (or infinite) always.
constexpr double kMostInverse = 1e300;

constexpr size_t kMostPackets = 64;  ///< of a tile, a bit each

/// Rays that walk through the cells together, a packet as many as there are lanes. t counts from
/// the point of the ray that is nearest to the region's middle: far eyes would eat the digits.
class Tile {
 public:
  static HWY_INLINE size_t lanes() { return hn::Lanes(D()); }
  static HWY_INLINE size_t most_rays() { return std::min(kTileRays, kMostPackets * lanes()); }

  /// At most most_rays() positions.
  void make_rays(const LaneScene& scene, const Camera& camera,
                 std::span<const PixelPosition> positions);
  /// At most most_rays() of any kind.
  void make_rays(const LaneScene& scene, std::span<const Ray> given);
  /// Hits of those that met something, nothing for the others.
  void write(const LaneScene& scene, const uint32_t* places, Hit* hits) const;

  HWY_INLINE L::Vec3 origin(size_t packet) const { return load(origin_, packet); }
  HWY_INLINE L::Vec3 direction(size_t packet) const { return load(direction_, packet); }
  HWY_INLINE Real start(size_t packet) const { return hn::Load(D(), start_ + packet * lanes()); }
  HWY_INLINE Real at_eye(size_t packet) const { return start(packet) + set(at_eye_); }
  /// Where a plane of cells is passed. Cells that share the plane share the bits.
  HWY_INLINE Real passes(size_t packet, int axis, double plane) const {
    return (set(plane) - axis_origin(packet, axis)) * axis_inverse(packet, axis);
  }
  HWY_INLINE Real axis_origin(size_t packet, int axis) const {
    return hn::Load(D(), origin_[axis] + packet * lanes());
  }
  HWY_INLINE Real axis_inverse(size_t packet, int axis) const {
    return hn::Load(D(), inverse_[axis] + packet * lanes());
  }
  HWY_INLINE void met(size_t packet, uint32_t lanes_met, Real t, Word what) {
    const Bool mask = mask_of(lanes_met);
    hn::BlendedStore(t, mask, D(), t_ + packet * lanes());
    hn::BlendedStore(what, hn::RebindMask(Words(), mask), Words(), what_ + packet * lanes());
    hit[packet] |= uint8_t(lanes_met);
  }
  void lane_met(size_t packet, uint32_t lane, double t, uint64_t what) {
    t_[packet * lanes() + lane] = t;
    what_[packet * lanes() + lane] = what;
    hit[packet] |= uint8_t(1u << lane);
  }
  void add_owner(size_t packet, uint32_t lane, uint32_t id) {
    what_[packet * lanes() + lane] |= uint64_t(id) << 32;
  }
  LocalRay ray(size_t packet, uint32_t lane) const { return ray(packet * lanes() + lane); }
  LocalRay ray(size_t i) const {
    return {{origin_[0][i], origin_[1][i], origin_[2][i]},
            {direction_[0][i], direction_[1][i], direction_[2][i]}};
  }

  /// What t at the ray's own start is more than t here.
  double shift(size_t i) const { return shift_[i]; }

  size_t rays = 0, packets = 0;
  bool from_within = false;  ///< some ray starts in the region
  double width = 0;          ///< of the tile, across the rays, about where the region's middle is
  double end = kInfinity;    ///< nobody asks what any of them meets beyond this t
  // By packet, a bit a lane.
  uint8_t meets[kMostPackets];        ///< the region
  uint8_t backward[3][kMostPackets];  ///< the direction is negative
  uint8_t known[kMostPackets];        ///< whether the ray is in the solid, so far
  uint8_t solid[kMostPackets];        ///< and it is
  uint8_t hit[kMostPackets];

 private:
  using Numbers = double[kTileRays];
  static HWY_INLINE L::Vec3 load(const Numbers* v, size_t packet) {
    const size_t i = packet * lanes();
    return {hn::Load(D(), v[0] + i), hn::Load(D(), v[1] + i), hn::Load(D(), v[2] + i)};
  }
  static void in_picture(const Camera& camera, const PixelPosition* positions, Real& x, Real& y);
  HWY_INLINE Real make_packet(const LaneScene& scene, const Camera& camera, size_t packet, Real x,
                              Real y);
  HWY_INLINE Real make_packet(const LaneScene& scene, size_t packet, L::Vec3 from, L::Vec3 d,
                              Real first);
  void begin(const LaneScene& scene, size_t count);
  void leave_out_beside();
  HWY_INLINE void write_packet(const LaneScene& scene, size_t packet, const uint32_t* places,
                               Hit* hits) const;

  double at_eye_ = 0;  ///< this far from its start a ray is where the eye is
  alignas(64) Numbers origin_[3];
  alignas(64) Numbers direction_[3];
  alignas(64) Numbers inverse_[3];  ///< of the direction
  alignas(64) Numbers shift_;       ///< t at the camera's start minus t here
  alignas(64) Numbers start_;
  alignas(64) Numbers t_;
  alignas(64) uint64_t what_[kTileRays];  ///< id, number of the half-space, and 1 if it is turned
};

HWY_INLINE uint64_t what_is_met(uint32_t id, uint32_t half_space, bool turned) {
  return uint64_t(id) << 32 | half_space << 1 | uint32_t(turned);
}

inline void Tile::make_rays(const LaneScene& scene, const Camera& camera,
                            std::span<const PixelPosition> positions) {
  begin(scene, positions.size());
  Real farthest = set(0);
  Real low_x = set(kInfinity), high_x = set(-kInfinity), low_y = low_x, high_y = high_x;
  for (size_t packet = 0; packet < packets; ++packet) {
    const size_t first = packet * lanes(), count = std::min(lanes(), rays - first);
    std::array<PixelPosition, kMaxLanes> some;
    const PixelPosition* of_packet = &positions[first];
    if (count < lanes()) {
      std::fill(std::copy_n(of_packet, count, some.begin()), some.end(), of_packet[0]);
      of_packet = some.data();
    }
    Real x, y;
    in_picture(camera, of_packet, x, y);
    low_x = hn::Min(low_x, x), high_x = hn::Max(high_x, x);
    low_y = hn::Min(low_y, y), high_y = hn::Max(high_y, y);
    farthest = hn::Max(farthest, hn::Abs(make_packet(scene, camera, packet, x, y)));
  }
  const auto most = [](Real v) { return hn::GetLane(hn::MaxOfLanes(D(), v)); };
  const double extent[2] = {most(high_x) + most(set(0) - low_x),
                            most(high_y) + most(set(0) - low_y)};
  width = std::max(extent[0], extent[1]);
  if (!camera.orthographic) width *= most(farthest);
  leave_out_beside();
}

inline void Tile::make_rays(const LaneScene& scene, std::span<const Ray> given) {
  begin(scene, given.size());
  Real low[3], high[3], last = set(-kInfinity);
  for (int axis = 0; axis < 3; ++axis) low[axis] = set(kInfinity), high[axis] = set(-kInfinity);
  for (size_t packet = 0; packet < packets; ++packet) {
    alignas(64) double from[3][kMaxLanes], way[3][kMaxLanes], start[kMaxLanes], stop[kMaxLanes];
    for (size_t lane = 0; lane < lanes(); ++lane) {
      const Ray& ray = given[std::min(packet * lanes() + lane, rays - 1)];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis][lane] = ray.origin[axis];
        way[axis][lane] = ray.direction[axis];
      }
      start[lane] = ray.t_min;
      stop[lane] = ray.t_max;
    }
    const auto loaded = [](const auto& v) {
      return L::Vec3{hn::Load(D(), v[0]), hn::Load(D(), v[1]), hn::Load(D(), v[2])};
    };
    const Real shift = make_packet(scene, packet, loaded(from), loaded(way), hn::Load(D(), start));
    last = hn::Max(last, hn::Load(D(), stop) - shift);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = hn::Min(low[axis], axis_origin(packet, axis));
      high[axis] = hn::Max(high[axis], axis_origin(packet, axis));
    }
  }
  end = hn::GetLane(hn::MaxOfLanes(D(), last));
  width = 0;
  for (int axis = 0; axis < 3; ++axis) {
    width = std::max(width, hn::GetLane(hn::MaxOfLanes(D(), high[axis])) -
                                hn::GetLane(hn::MinOfLanes(D(), low[axis])));
  }
  leave_out_beside();
}

inline void Tile::begin(const LaneScene& scene, size_t count) {
  rays = count;
  packets = (rays + lanes() - 1) / lanes();
  at_eye_ = kAtEye * scene.edge;
  from_within = false;
}

/// Lanes of the last packet that have no ray of their own.
inline void Tile::leave_out_beside() {
  const size_t beside = packets * lanes() - rays;
  if (beside != 0) meets[packets - 1] &= uint8_t((1u << (lanes() - beside)) - 1);
}

/// Where as many positions as there are lanes lie in the picture, from its middle.
HWY_INLINE void Tile::in_picture(const Camera& camera, const PixelPosition* positions, Real& x,
                                 Real& y) {
  static_assert(sizeof(PixelPosition) == 2 * sizeof(float));
  const hn::Rebind<float, D> floats;
  auto px = hn::Zero(floats), py = px;
  hn::LoadInterleaved2(floats, &positions[0].x, px, py);
  const Real scale = set(camera.units_per_pixel());
  x = (hn::PromoteTo(D(), px) - set(0.5 * camera.width)) * scale;
  y = (set(0.5 * camera.height) - hn::PromoteTo(D(), py)) * scale;
}

/// Returns the shifts.
HWY_INLINE Real Tile::make_packet(const LaneScene& scene, const Camera& camera, size_t packet,
                                  Real x, Real y) {
  const bool ortho = camera.orthographic;
  const L::Vec3 base = set(ortho ? camera.eye : camera.forward);
  const L::Vec3 point = L::picture_point(base, set(camera.right), set(camera.up), x, y);
  return make_packet(scene, packet, ortho ? point : set(camera.eye),
                     ortho ? set(camera.forward) : L::unit3(point),
                     set(ortho ? -camera.ortho_reach : 0));
}

/// Rays from points along unit directions, from t = `first` on; likewise.
HWY_INLINE Real Tile::make_packet(const LaneScene& scene, size_t packet, L::Vec3 from, L::Vec3 d,
                                  Real first) {
  const size_t i = packet * lanes();
  const L::Vec3 middle = set(scene.scene.origin);
  L::Vec3 o = {from.x - middle.x, from.y - middle.y, from.z - middle.z};
  const Real shift = set(0) - L::dot3(o, d);
  o = {o.x + d.x * shift, o.y + d.y * shift, o.z + d.z * shift};
  const Real start = first - shift;
  hn::Store(shift, D(), shift_ + i);
  hn::Store(start, D(), start_ + i);
  const Real os[3] = {o.x, o.y, o.z}, ds[3] = {d.x, d.y, d.z};
  Real t0 = start, t1 = set(kInfinity);
  for (int axis = 0; axis < 3; ++axis) {
    const Real inverse = hn::Max(hn::Min(set(1) / ds[axis], set(kMostInverse)), set(-kMostInverse));
    hn::Store(os[axis], D(), origin_[axis] + i);
    hn::Store(ds[axis], D(), direction_[axis] + i);
    hn::Store(inverse, D(), inverse_[axis] + i);
    backward[axis][packet] = uint8_t(bits(inverse < set(0)));
    const Real a = (set(scene.clip.lo[axis]) - os[axis]) * inverse;
    const Real b = (set(scene.clip.hi[axis]) - os[axis]) * inverse;
    t0 = hn::Max(t0, hn::Min(a, b));
    t1 = hn::Min(t1, hn::Max(a, b));
  }
  const uint32_t inside_first = bits(hn::Eq(t0, start));
  meets[packet] = uint8_t(bits(t0 < t1));
  // Outside the region of a bounded solid there is nothing; a ray that starts inside of it, or an
  // unbounded solid, tells only at its first cell.
  known[packet] = uint8_t(scene.scene.bounded ? ~inside_first : 0);
  solid[packet] = 0;
  hit[packet] = 0;
  from_within |= (bits(hn::Le(t0, start + set(at_eye_))) & meets[packet]) != 0;
  return shift;
}

inline void Tile::write(const LaneScene& scene, const uint32_t* places, Hit* hits) const {
  for (size_t packet = 0; packet < packets; ++packet) write_packet(scene, packet, places, hits);
}

HWY_INLINE void Tile::write_packet(const LaneScene& scene, size_t packet, const uint32_t* places,
                                   Hit* hits) const {
  const size_t first = packet * lanes(), count = std::min(lanes(), rays - first);
  if (hit[packet] == 0) {
    for (size_t i = first; i < first + count; ++i) hits[places[i]] = Hit{};
    return;
  }
  const Real t = hn::Load(D(), t_ + first);
  const L::Vec3 o = origin(packet), d = direction(packet);
  const L::Vec3 point = {o.x + d.x * t, o.y + d.y * t, o.z + d.z * t};
  const Word what = hn::Load(Words(), what_ + first);
  const Word ones = hn::Set(Words(), 1), surface = hn::And(what, hn::Set(Words(), 0xfffffffe));
  L::Vec3 gradient = {set(0), set(0), set(0)};
  for (uint32_t left = hit[packet]; left != 0;) {
    const uint32_t number = uint32_t(what_[first + uint32_t(std::countr_zero(left))]) >> 1;
    const Bool same = hn::RebindMask(D(), hn::Eq(surface, hn::Set(Words(), uint64_t(number) << 1)));
    left &= ~bits(same);
    const LaneHalfSpace& h = scene.half_spaces[number];
    L::Vec3 g;
    if (h.kind == AlongKind::kPlane) {
      g = set(h.v);
    } else {
      const L::Vec3 q = {point.x - set(h.center.x), point.y - set(h.center.y),
                         point.z - set(h.center.z)};
      if (h.kind == AlongKind::kSphere || h.kind == AlongKind::kSmallSphere) {
        g = {set(h.v.x) * q.x, set(h.v.x) * q.y, set(h.v.x) * q.z};
      } else {
        const auto& f = scene.scene.half_spaces[number].f;
        const Vec3 b = is_cone(h.kind) ? Vec3{} : f.b;
        g = L::quadric_half_gradient({set(f.diag), set(f.off), set(b), set(0)}, q);
      }
    }
    gradient = {L::select(same, g.x, gradient.x), L::select(same, g.y, gradient.y),
                L::select(same, g.z, gradient.z)};
  }
  const Real length = L::sqrt(L::dot3(gradient, gradient));
  const Real inverse = L::select(length > set(0), set(1) / length, set(0));
  // The sign bit of those that are turned.
  const Real sign = hn::BitCast(D(), hn::ShiftLeft<63>(hn::And(what, ones)));
  const hn::Rebind<float, D> floats;
  const hn::Rebind<uint32_t, D> ids;
  const Bool hits_it = mask_of(hit[packet]);
  const auto fact = [&](Real v, double otherwise) {
    return hn::DemoteTo(floats, L::select(hits_it, v, set(otherwise)));
  };
  const auto id = hn::TruncateTo(
      ids, hn::IfThenElseZero(hn::RebindMask(Words(), hits_it), hn::ShiftRight<32>(what)));
  alignas(64) float most_facts[4 * kMaxLanes], z[kMaxLanes];
  hn::StoreInterleaved4(fact(t + hn::Load(D(), shift_ + first), kInfinity), hn::BitCast(floats, id),
                        fact(hn::Xor(gradient.x * inverse, sign), 0),
                        fact(hn::Xor(gradient.y * inverse, sign), 0), floats, most_facts);
  hn::Store(fact(hn::Xor(gradient.z * inverse, sign), 0), floats, z);
  static_assert(sizeof(Hit) == 5 * sizeof(float) && offsetof(Hit, normal.z) == 4 * sizeof(float));
  for (size_t i = 0; i < count; ++i) {
    char* const to = reinterpret_cast<char*>(&hits[places[first + i]]);
    std::memcpy(to, &most_facts[4 * i], 4 * sizeof(float));
    std::memcpy(to + 4 * sizeof(float), &z[i], sizeof(float));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#endif

// Floats in vector lanes, and the camera's rays in them. To be included once an instruction set,
// inside its namespace (hwy/foreach_target.h). Sums and products stand in one order and nothing is
// fused, so every instruction set gives the same bits.

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kMostFloatLanes>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using Real = hn::Vec<D>;
using Int = hn::Vec<DI>;
using Word = hn::Vec<DU>;

struct Real3 {
  Real x, y, z;
};

HWY_INLINE Real set(float v) {
  return hn::Set(D(), v);
}
HWY_INLINE Real3 set(Vec3f v) {
  return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE Real3 add(Real3 a, Real3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Real3 sub(Real3 a, Real3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Real3 scale(Real3 a, Real s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE Real3 multiply(Real3 a, Real3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Real dot(Real3 a, Real3 b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Real3 select(hn::Mask<D> condition, Real3 yes, Real3 no) {
  return {hn::IfThenElse(condition, yes.x, no.x), hn::IfThenElse(condition, yes.y, no.y),
          hn::IfThenElse(condition, yes.z, no.z)};
}
HWY_INLINE Real3 negate(Real3 a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
HWY_INLINE Real positive(Real v) {
  return hn::IfThenElseZero(hn::Gt(v, set(0)), v);
}
/// The unit vectors along `a`; the zero vector stays zero.
HWY_INLINE Real3 unit(Real3 a) {
  const Real length = hn::Sqrt(dot(a, a));
  return scale(a, hn::IfThenElse(hn::Gt(length, set(0)), hn::Div(set(1), length), set(1)));
}
HWY_INLINE Real3 mix(Real3 a, Real3 b, Real t) {
  return add(a, scale(sub(b, a), t));
}

/// From the middle of the picture's plane to the picture positions.
HWY_INLINE Real3 picture_offset(const PixelRays& rays, Real px, Real py) {
  const Real units = set(rays.units_per_pixel);
  return add(scale(set(rays.right), hn::Mul(hn::Sub(px, set(rays.half_width)), units)),
             scale(set(rays.up), hn::Mul(hn::Sub(set(rays.half_height), py), units)));
}
/// The rays' unit directions.
HWY_INLINE Real3 ray_direction(const PixelRays& rays, Real px, Real py) {
  if (rays.orthographic) return set(rays.forward);
  return unit(add(set(rays.forward), picture_offset(rays, px, py)));
}
/// The points at `distance` along the rays of those directions, seen from the eye.
HWY_INLINE Real3 ray_point(const PixelRays& rays, Real3 direction, Real distance, Real px,
                           Real py) {
  const Real3 along = scale(direction, distance);
  return rays.orthographic ? add(picture_offset(rays, px, py), along) : along;
}

/// Hits, a lane each.
struct HitLanes {
  Word id;
  Real distance;
  Real3 normal;
};

/// Of as many hits as there are lanes.
HWY_INLINE HitLanes load_all_hits(const Hit* hits) {
  constexpr uint32_t kWords = 5;
  static_assert(sizeof(Hit) == kWords * sizeof(uint32_t) && offsetof(Hit, distance) == 0 &&
                offsetof(Hit, id) == 4 && offsetof(Hit, normal) == 8);
  const auto lanes = uint32_t(hn::Lanes(DU()));
  // Word w of hit i is the (5 i + w)th of five vectors in a row. As 5 and the number of lanes have
  // no common factor, each lane of these holds word w once: they are merged, then put in order.
  alignas(64) constexpr uint32_t kRests[] = {0, 1, 2, 3, 4, 0, 1, 2, 3, 4, 0, 1, 2, 3, 4, 0};
  static_assert(std::size(kRests) == kMostFloatLanes);
  const Word rest = hn::Load(DU(), kRests);
  const auto* words = reinterpret_cast<const uint32_t*>(hits);
  const auto word = [&](uint32_t w) HWY_ATTR {
    Word merged = hn::LoadU(DU(), words);
    for (uint32_t v = 1; v < kWords; ++v) {
      const uint32_t here = (w + kWords * lanes - v * lanes) % kWords;
      merged = hn::IfThenElse(hn::Eq(rest, hn::Set(DU(), here)),
                              hn::LoadU(DU(), words + v * lanes), merged);
    }
    const Word lane = hn::Iota(DU(), 0);
    const Word at = hn::Add(hn::Add(hn::ShiftLeft<2>(lane), lane), hn::Set(DU(), w));
    const Word in_order = hn::And(at, hn::Set(DU(), lanes - 1));
    return hn::TableLookupLanes(merged, hn::IndicesFromVec(DU(), in_order));
  };
  const auto number = [&](uint32_t w) HWY_ATTR { return hn::BitCast(D(), word(w)); };
  return {word(1), number(0), {number(2), number(3), number(4)}};
}

/// Of `count` hits; lanes beyond have none.
HWY_INLINE HitLanes load_hits(const Hit* hits, size_t count) {
  if (HWY_LIKELY(count == hn::Lanes(D()))) return load_all_hits(hits);
  Hit some[kMostFloatLanes];
  std::copy_n(hits, count, some);
  return load_all_hits(some);
}

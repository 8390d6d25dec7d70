#include "image/shade_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "base/instruction_set.h"

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/shade_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef WHITTLE_SHADE_CONSTANTS
#define WHITTLE_SHADE_CONSTANTS
namespace whittle {
namespace {

// The plain style's colours, in linear light.
constexpr Vec3f kKeyColor{0.82f, 0.80f, 0.77f}, kFillColor{0.11f, 0.12f, 0.14f};
constexpr Vec3f kRimColor{0.20f, 0.21f, 0.23f};
constexpr Vec3f kSkyColor{0.29f, 0.305f, 0.33f}, kGroundColor{0.11f, 0.105f, 0.10f};
/// The key light is as large as this share of a half-sphere: it reaches a little round the corner.
constexpr float kKeyWrap = 0.15f;
/// Reflection of a dielectric such as plastic, seen straight and at grazing angles.
constexpr float kReflectance = 0.04f, kGrazingReflectance = 0.35f;
constexpr float kHighlight = 0.16f;

/// The studio's: large lights, so that they reach far round a corner, and much light from all
/// sides.
struct StudioLight {
  static constexpr Vec3f kKey{0.50f, 0.49f, 0.475f}, kFill{0.10f, 0.108f, 0.12f};
  static constexpr Vec3f kRim{0.15f, 0.155f, 0.165f};
  static constexpr Vec3f kSky{0.45f, 0.46f, 0.475f}, kGround{0.20f, 0.195f, 0.19f};
  static constexpr float kWrap = 0.3f;
  static constexpr float kReflectance = 0.035f, kGrazingReflectance = 0.25f;
  static constexpr float kHighlight = 0.10f;
};

}  // namespace
}  // namespace whittle
#endif

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

#include "image/lanes.inl"

/// Hits and the places they are seen through, a lane each.
struct Seen {
  Real3 normal, base;
  Real distance, px, py;
  Word shadows;
  Real openness;
};

/// 0 where a light of that bit does not reach.
HWY_INLINE Real where_lit(const Seen& s, uint32_t bit, Real v) {
  const auto dark = hn::TestBit(s.shadows, hn::Set(DU(), bit));
  return hn::IfThenZeroElse(hn::RebindMask(D(), dark), v);
}

// OpenSCAD: rgb = base * (ambient + |n.l|), two opposite lights fixed to the camera.
struct Openscad {
  static HWY_INLINE Real3 color(const ShadeParameters& p, const Seen& s) {
    return scale(s.base, hn::Add(set(p.ambient), hn::Abs(dot(s.normal, set(p.headlight)))));
  }
};

// The paper's algorithm 4, with l from the hit to the light and v from the hit to the eye. Seen
// from inside the solid the normal is turned to the eye, as the inner side is what is seen.
struct Blinn {
  static HWY_INLINE Real3 color(const ShadeParameters& p, const Seen& s) {
    const Real3 d = ray_direction(p.rays, s.px, s.py);
    const Real3 n = select(hn::Gt(dot(s.normal, d), set(0)), negate(s.normal), s.normal);
    const Real3 l = unit(sub(set(p.light_from_eye), ray_point(p.rays, d, s.distance, s.px, s.py)));
    const Real n_l = where_lit(s, 1, dot(n, l));
    Real highlight = positive(dot(n, unit(sub(l, d))));
    static_assert(kBlinnExponent == 16);
    for (int i = 0; i < 4; ++i) highlight = hn::Mul(highlight, highlight);
    const Real white = hn::Mul(set(kBlinnSpecular), highlight);
    const Real3 lit = scale(s.base, hn::Add(set(kBlinnAmbient), hn::Mul(set(kBlinnDiffuse), n_l)));
    return select(hn::Gt(n_l, set(0)), add(lit, {white, white, white}),
                  scale(s.base, set(kBlinnAmbient)));
  }
};

// A key, a fill and a rim light and a sky above a ground, over a smooth dielectric that mirrors sky
// and ground a little, more at grazing angles.
struct Plain {
  static HWY_INLINE Real3 color(const ShadeParameters& p, const Seen& s) {
    const Real3 d = ray_direction(p.rays, s.px, s.py);
    Real n_d = dot(s.normal, d);
    const auto inner = hn::Gt(n_d, set(0));
    const Real3 n = select(inner, negate(s.normal), s.normal);
    n_d = hn::IfThenElse(inner, hn::Neg(n_d), n_d);

    const float wrap = p.has_shadows ? 0 : kKeyWrap;
    const Real key =
        where_lit(s, 1, positive(hn::Div(hn::Add(dot(n, set(p.key)), set(wrap)), set(1 + wrap))));
    const Real fill = where_lit(s, 2, positive(dot(n, set(p.fill))));
    const Real rim = where_lit(s, 4, positive(dot(n, set(p.rim))));
    Real3 light = surroundings(n.z);
    light = add(light, scale(set(kKeyColor), key));
    light = add(light, scale(set(kFillColor), fill));
    light = add(light, scale(set(kRimColor), rim));

    const Real3 mirrored = sub(d, scale(n, hn::Mul(set(2), n_d)));
    const Real grazing = hn::Add(set(1), n_d), grazing2 = hn::Mul(grazing, grazing);
    const Real growth = hn::Mul(
        hn::Mul(hn::Mul(set(kGrazingReflectance - kReflectance), grazing2), grazing2), grazing);
    const Real reflectance = hn::Add(set(kReflectance), growth);
    Real highlight = where_lit(s, 1, positive(dot(mirrored, set(p.key))));
    for (int i = 0; i < 5; ++i) highlight = hn::Mul(highlight, highlight);
    const Real3 reflected = add(scale(surroundings(mirrored.z), hn::Mul(set(2), reflectance)),
                                scale(set(kKeyColor), hn::Mul(highlight, set(kHighlight))));
    return add(scale(multiply(s.base, light), hn::Sub(set(1), reflectance)), reflected);
  }

  static HWY_INLINE Real3 surroundings(Real up) {
    return mix(set(kGroundColor), set(kSkyColor), hn::Add(set(0.5f), hn::Mul(set(0.5f), up)));
  }
};

// The same lights, larger, where the surroundings are seen only as far as nothing stands before
// them.
struct Studio {
  using L = StudioLight;

  static HWY_INLINE Real3 color(const ShadeParameters& p, const Seen& s) {
    const Real3 d = ray_direction(p.rays, s.px, s.py);
    Real n_d = dot(s.normal, d);
    const auto inner = hn::Gt(n_d, set(0));
    const Real3 n = select(inner, negate(s.normal), s.normal);
    n_d = hn::IfThenElse(inner, hn::Neg(n_d), n_d);

    const float wrap = p.has_shadows ? 0 : L::kWrap;
    const Real key =
        where_lit(s, 1, positive(hn::Div(hn::Add(dot(n, set(p.key)), set(wrap)), set(1 + wrap))));
    const Real fill = where_lit(s, 2, positive(dot(n, set(p.fill))));
    const Real rim = where_lit(s, 4, positive(dot(n, set(p.rim))));
    // A large light is hidden by less than what hides all surroundings.
    const Real hidden = hn::Sub(set(1), s.openness);
    const Real seen =
        hn::Sub(set(1), hn::Mul(hidden, hn::Add(set(0.4f), hn::Mul(set(0.6f), hidden))));
    Real3 direct = scale(set(L::kKey), key);
    direct = add(direct, scale(set(L::kFill), fill));
    direct = add(direct, scale(set(L::kRim), rim));
    const Real3 around = surroundings(n.z);
    const Real3 diffuse = {lit(s.base.x, direct.x, around.x, seen, s.openness),
                           lit(s.base.y, direct.y, around.y, seen, s.openness),
                           lit(s.base.z, direct.z, around.z, seen, s.openness)};

    const Real3 mirrored = sub(d, scale(n, hn::Mul(set(2), n_d)));
    const Real grazing = hn::Add(set(1), n_d), grazing2 = hn::Mul(grazing, grazing);
    const Real growth =
        hn::Mul(hn::Mul(hn::Mul(set(L::kGrazingReflectance - L::kReflectance), grazing2), grazing2),
                grazing);
    const Real reflectance = hn::Add(set(L::kReflectance), growth);
    Real highlight = where_lit(s, 1, positive(dot(mirrored, set(p.key))));
    for (int i = 0; i < 5; ++i) highlight = hn::Mul(highlight, highlight);
    const Real3 reflected = scale(add(scale(surroundings(mirrored.z), hn::Mul(set(2), reflectance)),
                                      scale(set(L::kKey), hn::Mul(highlight, set(L::kHighlight)))),
                                  hn::Mul(s.openness, s.openness));
    return add(scale(diffuse, hn::Sub(set(1), reflectance)), reflected);
  }

  // What light a surface of that albedo gets from its surroundings if it sees this share of them,
  // and what hides the rest is of the same colour and lit alike. A cubic fit of what bounces many
  // times between them: Jimenez, Wu, Pesce and Jarabo, "Practical realtime strategies for accurate
  // indirect occlusion" (2016), section 5.
  static HWY_INLINE Real bounced(Real albedo, Real openness) {
    const auto line = [&](float slope, float at_0)
                          HWY_ATTR { return hn::Add(hn::Mul(set(slope), albedo), set(at_0)); };
    const Real cubic = hn::Mul(hn::Add(hn::Mul(hn::Add(hn::Mul(line(2.0404f, -0.3324f), openness),
                                                       line(-4.7951f, 0.6417f)),
                                               openness),
                                       line(2.7552f, 0.6903f)),
                               openness);
    return hn::Max(openness, cubic);
  }
  static HWY_INLINE Real lit(Real base, Real direct, Real around, Real seen, Real openness) {
    return hn::Mul(base, hn::Add(hn::Mul(direct, seen), hn::Mul(around, bounced(base, openness))));
  }
  static HWY_INLINE Real3 surroundings(Real up) {
    return mix(set(L::kGround), set(L::kSky), hn::Add(set(0.5f), hn::Mul(set(0.5f), up)));
  }
};

HWY_INLINE Real3 background(const ShadeParameters& p, Real py) {
  return mix(set(p.top), set(p.bottom), hn::Mul(py, set(p.inverse_height)));
}

/// Which of the materials the hits have.
HWY_INLINE Word load_looks(const ShadeParameters& p, const SeenHits& seen, size_t i, Word id) {
  return seen.looks.empty() ? hn::Min(id, hn::Set(DU(), p.last)) : hn::LoadU(DU(), &seen.looks[i]);
}
/// And which lights do not reach them.
HWY_INLINE Word load_shadows(const SeenHits& seen, size_t i) {
  return seen.shadows.empty() ? hn::Zero(DU()) : hn::LoadU(DU(), &seen.shadows[i]);
}

/// And how much of their surroundings they see.
HWY_INLINE Real load_openness(const SeenHits& seen, size_t i) {
  return seen.openness.empty() ? set(1) : hn::LoadU(D(), &seen.openness[i]);
}

/// The base colours. Neighbours mostly have one, and looking up many takes longer.
HWY_INLINE Real3 load_materials(const ShadeParameters& p, Word look) {
  const uint32_t first_look = hn::GetLane(look);
  if (hn::AllTrue(DU(), hn::Eq(look, hn::Set(DU(), first_look))))
    return set(p.materials[first_look]);
  const Int at = hn::Mul(hn::BitCast(DI(), look), hn::Set(DI(), 3));
  const Vec3f& first = p.materials[0];
  return {hn::GatherIndex(D(), &first.x, at), hn::GatherIndex(D(), &first.y, at),
          hn::GatherIndex(D(), &first.z, at)};
}

/// The surfaces' colours; anything where nothing is hit.
template <class Look>
HWY_INLINE Real3 surface(const ShadeParameters& p, const SeenHits& seen, size_t i,
                         const HitLanes& hits, Word look, Real px, Real py) {
  return Look::color(p, {hits.normal, load_materials(p, look), hits.distance, px, py,
                         load_shadows(seen, i), load_openness(seen, i)});
}

/// Values in 0..1 as 8 bits, rounded; what lies outside is clamped and NaN is 0.
HWY_INLINE Int to_steps(Real v, float steps) {
  const Real inside = hn::Min(positive(v), set(1));
  return hn::ConvertTo(DI(), hn::Add(hn::Mul(inside, set(steps)), set(0.5f)));
}

/// A component in its byte.
HWY_INLINE Int encode(const ShadeParameters& p, Real v) {
  if (!is_linear(p.style)) return to_steps(v, 255);
  const auto* table = reinterpret_cast<const int32_t*>(p.srgb->data());
  return hn::And(hn::GatherOffset(DI(), table, to_steps(v, kSrgbSteps)), hn::Set(DI(), 255));
}

/// Four bytes a lane, red in the lowest.
HWY_INLINE Word pack(const ShadeParameters& p, Real3 color, Real alpha) {
  static_assert(std::endian::native == std::endian::little);
  const Int red = encode(p, color.x), green = encode(p, color.y), blue = encode(p, color.z);
  const Int rgba = hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)),
                          hn::Or(hn::ShiftLeft<16>(blue), hn::ShiftLeft<24>(to_steps(alpha, 255))));
  return hn::BitCast(DU(), rgba);
}

HWY_INLINE void store(Word pixels, size_t count, uint8_t* rgba) {
  if (count == hn::Lanes(DU())) {
    hn::StoreU(pixels, DU(), reinterpret_cast<uint32_t*>(rgba));
    return;
  }
  HWY_ALIGN uint32_t words[kMostFloatLanes];
  hn::Store(pixels, DU(), words);
  std::memcpy(rgba, words, 4 * count);
}

template <class Look>
void row(const ShadeParameters& p, const SeenHits& seen, int y, uint8_t* rgba) {
  const Real py = set(float(y) + 0.5f);
  const Word behind = p.has_background ? pack(p, background(p, py), set(1)) : hn::Zero(DU());
  for (size_t i = 0; i < seen.hits.size(); i += hn::Lanes(D())) {
    const size_t count = std::min(seen.hits.size() - i, hn::Lanes(D()));
    const HitLanes hits = load_hits(&seen.hits[i], count);
    const Word look = load_looks(p, seen, i, hits.id);
    const auto missed = hn::Eq(look, hn::Zero(DU()));
    Word pixels = behind;
    if (!hn::AllTrue(DU(), missed)) {
      const Real px = hn::Add(hn::Iota(D(), float(i)), set(0.5f));
      const Real3 color = surface<Look>(p, seen, i, hits, look, px, py);
      pixels = hn::IfThenElse(missed, behind, pack(p, color, set(1)));
    }
    store(pixels, count, rgba + 4 * i);
  }
}

template <class Look>
void samples(const ShadeParameters& p, const SeenHits& seen, std::span<const PixelPosition> places,
             Colors& colors) {
  const Real behind = set(p.has_background ? 1.0f : 0.0f);
  for (size_t i = 0; i < seen.hits.size(); i += hn::Lanes(D())) {
    const size_t count = std::min(seen.hits.size() - i, hn::Lanes(D()));
    HWY_ALIGN float x[kMostFloatLanes] = {}, y[kMostFloatLanes] = {};
    for (size_t k = 0; k < count; ++k) x[k] = places[i + k].x, y[k] = places[i + k].y;
    const Real px = hn::Load(D(), x), py = hn::Load(D(), y);
    const HitLanes hits = load_hits(&seen.hits[i], count);
    const Word look = load_looks(p, seen, i, hits.id);
    const auto missed = hn::RebindMask(D(), hn::Eq(look, hn::Zero(DU())));
    const Real3 color =
        select(missed, background(p, py), surface<Look>(p, seen, i, hits, look, px, py));
    hn::StoreU(color.x, D(), &colors.r[i]);
    hn::StoreU(color.y, D(), &colors.g[i]);
    hn::StoreU(color.z, D(), &colors.b[i]);
    hn::StoreU(hn::IfThenElse(missed, behind, set(1)), D(), &colors.alpha[i]);
  }
}

void row_in_lanes(const ShadeParameters& p, const SeenHits& seen, int y, uint8_t* rgba) {
  switch (p.style) {
    case Style::kStudio:
      return row<Studio>(p, seen, y, rgba);
    case Style::kPlain:
      return row<Plain>(p, seen, y, rgba);
    case Style::kBlinn:
      return row<Blinn>(p, seen, y, rgba);
    case Style::kOpenscad:
      return row<Openscad>(p, seen, y, rgba);
  }
}

void samples_in_lanes(const ShadeParameters& p, const SeenHits& seen,
                      std::span<const PixelPosition> places, Colors& colors) {
  switch (p.style) {
    case Style::kStudio:
      return samples<Studio>(p, seen, places, colors);
    case Style::kPlain:
      return samples<Plain>(p, seen, places, colors);
    case Style::kBlinn:
      return samples<Blinn>(p, seen, places, colors);
    case Style::kOpenscad:
      return samples<Openscad>(p, seen, places, colors);
  }
}

void store_in_lanes(const ShadeParameters& p, const Colors& colors, uint8_t* rgba) {
  for (size_t i = 0; i < colors.size; i += hn::Lanes(D())) {
    const Real3 color{hn::LoadU(D(), &colors.r[i]), hn::LoadU(D(), &colors.g[i]),
                      hn::LoadU(D(), &colors.b[i])};
    store(pack(p, color, hn::LoadU(D(), &colors.alpha[i])),
          std::min(colors.size - i, hn::Lanes(D())), rgba + 4 * i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {

WHITTLE_EXPORT(row_in_lanes);
WHITTLE_EXPORT(samples_in_lanes);
WHITTLE_EXPORT(store_in_lanes);

void shade_row(const ShadeParameters& shader, const SeenHits& seen, int y, uint8_t* rgba) {
  WHITTLE_DISPATCH(row_in_lanes)(shader, seen, y, rgba);
}

void shade_samples(const ShadeParameters& shader, const SeenHits& seen,
                   std::span<const PixelPosition> places, Colors& colors) {
  colors.resize(seen.hits.size());
  WHITTLE_DISPATCH(samples_in_lanes)(shader, seen, places, colors);
}

void store_colors(const ShadeParameters& shader, const Colors& colors, uint8_t* rgba) {
  WHITTLE_DISPATCH(store_in_lanes)(shader, colors, rgba);
}

}  // namespace whittle
#endif

#include "image/edge_lanes.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "base/instruction_set.h"

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/edge_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef WHITTLE_EDGE_CONSTANTS
#define WHITTLE_EDGE_CONSTANTS
namespace whittle {
namespace {

constexpr float kDepthStepPixels = 2;

}  // namespace
}  // namespace whittle
#endif

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

#include "image/lanes.inl"

HWY_INLINE Real3 load3(const EdgeRow& row, EdgeRow::Column first, size_t at) {
  return {hn::LoadU(D(), &row.columns[first][at]), hn::LoadU(D(), &row.columns[first + 1][at]),
          hn::LoadU(D(), &row.columns[first + 2][at])};
}
HWY_INLINE void store3(Real3 v, EdgeRow& row, EdgeRow::Column first, size_t at) {
  hn::StoreU(v.x, D(), &row.columns[first][at]);
  hn::StoreU(v.y, D(), &row.columns[first + 1][at]);
  hn::StoreU(v.z, D(), &row.columns[first + 2][at]);
}

void look_in_lanes(const PixelRays& rays, std::span<const Hit> hits, int y, EdgeRow& row) {
  uint32_t* ids = &row.ids[EdgeRow::kBefore];
  const Real py = set(float(y) + 0.5f);
  const float step = kDepthStepPixels * rays.units_per_pixel;
  for (size_t x = 0; x < hits.size(); x += hn::Lanes(D())) {
    const size_t count = std::min(hits.size() - x, hn::Lanes(D())), at = EdgeRow::kBefore + x;
    const HitLanes seen = load_hits(&hits[x], count);
    hn::StoreU(seen.id, DU(), ids + x);
    if (hn::AllTrue(DU(), hn::Eq(seen.id, hn::Zero(DU())))) continue;
    const Real px = hn::Add(hn::Iota(D(), float(x)), set(0.5f));
    const Real3 direction = ray_direction(rays, px, py);
    store3(seen.normal, row, EdgeRow::kNormalX, at);
    store3(direction, row, EdgeRow::kDirectionX, at);
    store3(ray_point(rays, direction, seen.distance, px, py), row, EdgeRow::kPointX, at);
    hn::StoreU(rays.orthographic ? set(step) : hn::Mul(set(step), seen.distance), D(),
               &row.columns[EdgeRow::kStep][at]);
  }
}

/// The distance along b's ray from b to the tangent plane of a is |n_a.(b - a)| / |n_a.d_b|.
HWY_INLINE hn::Mask<D> off_plane(Real3 normal, Real3 between, Real3 other_direction, Real step) {
  return hn::Gt(hn::Abs(dot(normal, between)),
                hn::Mul(step, hn::Abs(dot(normal, other_direction))));
}

HWY_INLINE hn::Mask<D> differ(const EdgeRow& row_a, size_t a, const EdgeRow& row_b, size_t b,
                              float least_cosine) {
  const Word id = hn::LoadU(DU(), &row_a.ids[a]);
  const auto other = hn::RebindMask(D(), hn::Ne(id, hn::LoadU(DU(), &row_b.ids[b])));
  const auto hit = hn::RebindMask(D(), hn::Ne(id, hn::Zero(DU())));
  if (hn::AllFalse(D(), hn::AndNot(other, hit))) return other;
  const Real3 normal_a = load3(row_a, EdgeRow::kNormalX, a),
              normal_b = load3(row_b, EdgeRow::kNormalX, b);
  const auto crease = hn::Lt(dot(normal_a, normal_b), set(least_cosine));
  const Real3 between = sub(load3(row_b, EdgeRow::kPointX, b), load3(row_a, EdgeRow::kPointX, a));
  const Real step = hn::Max(hn::LoadU(D(), &row_a.columns[EdgeRow::kStep][a]),
                            hn::LoadU(D(), &row_b.columns[EdgeRow::kStep][b]));
  const auto apart =
      hn::And(off_plane(normal_a, between, load3(row_b, EdgeRow::kDirectionX, b), step),
              off_plane(normal_b, between, load3(row_a, EdgeRow::kDirectionX, a), step));
  return hn::Or(other, hn::And(hit, hn::Or(crease, apart)));
}

HWY_INLINE Word bit_where(hn::Mask<D> mask, uint32_t bit) {
  return hn::IfThenElseZero(hn::RebindMask(DU(), mask), hn::Set(DU(), bit));
}

void differences_in_lanes(const EdgeRow& here, const EdgeRow* below, float least_cosine,
                          std::span<uint8_t> bits) {
  for (size_t x = 0; x < bits.size(); x += hn::Lanes(D())) {
    const size_t at = EdgeRow::kBefore + x;
    Word found = bit_where(differ(here, at, here, at + 1, least_cosine), kRight);
    if (below != nullptr) {
      found = hn::Or(found, bit_where(differ(here, at, *below, at - 1, least_cosine), kBelowLeft));
      found = hn::Or(found, bit_where(differ(here, at, *below, at, least_cosine), kBelow));
      found = hn::Or(found, bit_where(differ(here, at, *below, at + 1, least_cosine), kBelowRight));
    }
    HWY_ALIGN uint32_t words[kMostFloatLanes];
    hn::Store(found, DU(), words);
    const size_t count = std::min(bits.size() - x, hn::Lanes(D()));
    for (size_t k = 0; k < count; ++k) bits[x + k] = uint8_t(words[k]);
  }
  bits.front() &= uint8_t(~kBelowLeft);
  bits.back() &= uint8_t(~(kRight | kBelowRight));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {

WHITTLE_EXPORT(look_in_lanes);
WHITTLE_EXPORT(differences_in_lanes);

void look_at_row(const PixelRays& rays, std::span<const Hit> hits, int y, EdgeRow& row) {
  WHITTLE_DISPATCH(look_in_lanes)(rays, hits, y, row);
}

void find_differences(const EdgeRow& here, const EdgeRow* below, float least_cosine,
                      std::span<uint8_t> bits) {
  WHITTLE_DISPATCH(differences_in_lanes)(here, below, least_cosine, bits);
}

}  // namespace whittle
#endif

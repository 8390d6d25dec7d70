#include "subdivide/unit_boxes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/instruction_set.h"

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "subdivide/unit_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// `entries` holds eight floats a unit, `cell` centre and half size. Looks at kBatch units.
UnitBoxes::Batch look_at(const int32_t* units, const float* entries, const float* cell) {
  using F = hn::CappedTag<float, 16>;
  using I = hn::RebindToSigned<F>;
  UnitBoxes::Batch batch;
  for (uint32_t first = 0; first < UnitBoxes::kBatch; first += uint32_t(hn::Lanes(F()))) {
    const auto at = hn::ShiftLeft<3>(hn::Load(I(), units + first));
    const auto value = [&](int k) HWY_ATTR { return hn::GatherIndex(F(), entries + k, at); };
    const auto zero = hn::Zero(F());
    auto near_square = zero, far_square = zero;
    auto apart = hn::Lt(zero, zero);
    for (int axis = 0; axis < 3; ++axis) {
      const auto half = hn::Set(F(), cell[3 + axis]);
      const auto away = hn::Abs(hn::Sub(value(axis), hn::Set(F(), cell[axis])));
      const auto nearest = hn::Sub(away, half), farthest = hn::Add(away, half);
      apart = hn::Or(apart, hn::Gt(nearest, value(3 + axis)));
      const auto beyond = hn::Max(nearest, zero);
      near_square = hn::Add(near_square, hn::Mul(beyond, beyond));
      far_square = hn::Add(far_square, hn::Mul(farthest, farthest));
    }
    const auto outer = value(6), inner = value(7);
    const auto bits = [&](auto mask) HWY_ATTR {
      uint8_t bytes[8] = {};
      hn::StoreMaskBits(F(), mask, bytes);
      return uint32_t(bytes[0] | bytes[1] << 8) << first;
    };
    batch.beside |= bits(hn::Or(apart, hn::Gt(near_square, outer)));
    batch.within |= bits(hn::Lt(far_square, inner));
    batch.balls |= bits(hn::Lt(outer, hn::Set(F(), std::numeric_limits<float>::infinity())));
  }
  return batch;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {
namespace {

WHITTLE_EXPORT(look_at);

/// Of the coordinates' size; the arithmetic takes some ten roundings of 2^-24 of it.
constexpr double kLost = 2e-6;
constexpr double kSmallCell = 100 * kLost;

/// Units that one thread packs in one go.
constexpr size_t kUnitsEach = 4096;

}  // namespace

UnitBoxes::UnitBoxes(const Scene& scene, const Workers* workers)
    : scene_(scene),
      region_edge_(scene.region.is_empty() ? 0 : max_component(scene.region.size())),
      entries_(scene.units.size() + 1) {
  static_assert(sizeof(Entry) == 8 * sizeof(float));
  std::atomic<size_t> balls = 0;
  for_parts(workers, scene.units.size(), kUnitsEach, [&](size_t first, size_t last, size_t) {
    size_t found = 0;
    for (size_t i = first; i < last; ++i) {
      entries_[i] = entry(scene.units[i]);
      found += entries_[i].outer_square < kEverywhere;
    }
    balls += found;
  });
  balls_ = balls;
  entries_.back() = Entry();
}

UnitBoxes::Entry UnitBoxes::entry(const Unit& unit) const {
  if (unit.face_count == 0) return {};
  const Literal literal = scene_.faces[unit.first_face].literal;
  const HalfSpace& h = scene_.half_spaces[literal >> 1];
  const bool is_ball = unit.face_count == 1 && h.kind == SurfaceKind::kSphere && (literal & 1) == 0;
  const double radius = is_ball ? std::sqrt(-h.f.c / h.f.diag.x) : 0;
  const Vec3 center = is_ball ? h.center : unit.outer.center();
  const Vec3 half = is_ball ? Vec3{radius, radius, radius} : unit.outer.size() * 0.5;
  const double lost = kLost * (max_component(abs(center)) + max_component(half) + region_edge_);
  // What is too large for single precision is everywhere.
  if (!(lost < 1e15)) return {};
  Entry entry;
  for (int axis = 0; axis < 3; ++axis) {
    entry.center[axis] = float(center[axis]);
    entry.half[axis] = float(half[axis] + lost);
  }
  if (is_ball) {
    const double outer = radius + lost, inner = std::max(radius - lost, 0.0);
    entry.outer_square = float(outer * outer * (1 + kLost));
    entry.inner_square = float(inner * inner * (1 - kLost));
  }
  return entry;
}

UnitBoxes::Batch UnitBoxes::look_at(std::span<const Token> tokens, const CellBox& cell) const {
  // HWY_ALIGN would be the alignment of the baseline here, outside of the instruction sets.
  alignas(64) int32_t units[kBatch];
  std::fill(units, units + kBatch, int32_t(entries_.size() - 1));
  uint32_t negated = 0;
  for (size_t i = 0; i < tokens.size(); ++i) {
    const Token token = tokens[i];
    negated |= uint32_t(token.negated()) << i;
    if (token.kind() == TokenKind::kFace)
      units[i] = int32_t(scene_.faces[token.payload()].unit);
    else if (token.kind() == TokenKind::kUnit)
      units[i] = int32_t(token.payload());
  }
  float box[6];
  for (int axis = 0; axis < 3; ++axis) {
    box[axis] = float(cell.center[axis]);
    box[3 + axis] = float(cell.half[axis]);
  }
  Batch batch =
      WHITTLE_DISPATCH(look_at)(units, reinterpret_cast<const float*>(entries_.data()), box);
  batch.negated = negated;
  // In a cell so small that what is lost here counts, only proofs do.
  if (max_component(cell.half) < kSmallCell * region_edge_) batch.balls = 0;
  return batch;
}

}  // namespace whittle
#endif

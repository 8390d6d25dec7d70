#include "lower/half_space_table.h"

#include <algorithm>

namespace whittle {
namespace {

using K = Kernels<double>;

constexpr uint32_t kNone = UINT32_MAX;

/// Width of a bucket in fingerprint units, and how near to its border a fingerprint must be for the
/// neighbour to be searched too. The slack is far above the tolerance (2e-6) for all but tiny
/// curved surfaces, and wide buckets keep the number of neighbours low.
constexpr double kBucketWidth = 1.0 / 64;
constexpr double kBucketSlack = kBucketWidth / 16;

uint64_t bucket(const int64_t cell[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    hash = (hash ^ uint64_t(cell[i])) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

/// The quadric about another centre: q = q' + shift.
K::Quadric recentred(const K::Quadric& f, Vec3 shift) {
  K::Quadric r = f;
  r.b = K::quadric_half_gradient(f, shift);
  r.c = K::quadric_value(f, shift);
  return r;
}

}  // namespace

HalfSpaceTable::Fingerprint HalfSpaceTable::fingerprint(const HalfSpace& h) const {
  // The values of f at three points in general position tell surfaces apart and hardly change
  // between nearly equal ones; asinh tames the growth of quadrics far from their surface.
  static constexpr Vec3 kProbes[3] = {
      {0.413, -0.287, 0.619}, {-0.531, 0.347, 0.271}, {0.179, 0.683, -0.443}};
  Fingerprint r;
  for (int i = 0; i < 3; ++i)
    r.value[i] = std::asinh(K::quadric_value(h.f, kProbes[i] * radius_ - h.center) / radius_);
  return r;
}

bool HalfSpaceTable::same(const HalfSpace& known, const HalfSpace& h, double extent,
                          bool complement) const {
  if (known.is_plane() != h.is_plane()) return false;
  if (h.is_plane()) {
    // b is half the unit normal.
    const Vec3 n = known.f.b * 2.0, m = h.f.b * (complement ? -2.0 : 2.0);
    return length(n - m) * radius_ <= tolerance_ &&
           std::fabs(dot(n, h.center - known.center)) <= tolerance_;
  }
  const Vec3 shift = known.center - h.center;
  const double reach = extent + length(shift);
  const K::Quadric f = recentred(h.f, shift);
  const K::Quadric& g = known.f;
  const double second = length(f.diag - g.diag) + 2 * length(f.off - g.off);
  return second * reach * reach + 2 * length(f.b - g.b) * reach + std::fabs(f.c - g.c) <=
         tolerance_;
}

int64_t HalfSpaceTable::find(const HalfSpace& h, const Fingerprint& at, double extent,
                             bool complement) const {
  // Every cell that holds a fingerprint within the slack: one, or two an axis near a border.
  int64_t low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    const double v = complement ? -at.value[i] : at.value[i];
    low[i] = int64_t(std::floor((v - kBucketSlack) / kBucketWidth));
    high[i] = int64_t(std::floor((v + kBucketSlack) / kBucketWidth));
  }
  uint32_t best = kNone;
  int64_t cell[3];
  for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
    for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
      for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
        const auto found = head_.find(bucket(cell));
        if (found == head_.end()) continue;
        for (uint32_t i = found->second; i != kNone; i = next_[i])
          if (i < best && same(half_spaces_[i], h, extent, complement)) best = i;
      }
  return best == kNone ? -1 : int64_t(best);
}

Literal HalfSpaceTable::add(const HalfSpace& h, double extent) {
  const Fingerprint at = fingerprint(h);
  if (const int64_t i = find(h, at, extent, false); i >= 0) return Literal(i) * 2;
  // Only planes come in complementary pairs: no primitive is the outside of a quadric.
  if (h.is_plane())
    if (const int64_t i = find(h, at, extent, true); i >= 0) return Literal(i) * 2 + 1;
  const uint32_t number = uint32_t(half_spaces_.size());
  half_spaces_.push_back(h);
  int64_t cell[3];
  for (int i = 0; i < 3; ++i) cell[i] = int64_t(std::floor(at.value[i] / kBucketWidth));
  const auto [entry, fresh] = head_.try_emplace(bucket(cell), number);
  next_.push_back(fresh ? kNone : entry->second);
  entry->second = number;
  return Literal(number) * 2;
}

}  // namespace whittle

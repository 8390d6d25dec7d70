#include "lower/half_space_table.h"

#include <algorithm>

namespace whittle {
namespace {

using K = Kernels<double>;

constexpr uint32_t kNone = UINT32_MAX;

/// Width of a bucket in fingerprint units.
constexpr double kBucketWidth = 1.0 / 64;

uint64_t bucket(const int64_t cell[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    hash = (hash ^ uint64_t(cell[i])) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

/// Frobenius norm of the second-degree part.
double curvature(const K::Quadric& f) {
  return std::sqrt(dot(f.diag, f.diag) + 2 * dot(f.off, f.off));
}

}  // namespace

HalfSpaceTable::Fingerprint HalfSpaceTable::fingerprint(const HalfSpace& h,
                                                        const Reach& reach) const {
  // The values of f at three points in general position tell surfaces apart and hardly change
  // between nearly equal ones. A quadric's are taken relative to its own second degree: equal over
  // a small primitive, two may part far away from it, but in those units by no more than in shape.
  // asinh tames the growth of what is far off.
  static constexpr Vec3 kProbes[3] = {
      {0.413, -0.287, 0.619}, {-0.531, 0.347, 0.271}, {0.179, 0.683, -0.443}};
  const double unit = h.is_plane() ? radius_ : curvature(h.f) * radius_ * radius_;
  Fingerprint r;
  // A model of 1e-320 overflows here: all that cannot be told apart any more goes to one place.
  const auto bounded = [](double x) { return std::fabs(x) < 1e3 ? x : 0; };
  for (int i = 0; i < 3; ++i)
    r.value[i] = bounded(std::asinh(K::quadric_value(h.f, kProbes[i] * radius_ - h.center) / unit));
  const double size = std::min({reach.width, reach.radius, radius_});
  r.slack = size > 0 ? 16 * reach.tolerance / size : 0;
  return r;
}

bool HalfSpaceTable::same_plane(uint32_t number, const HalfSpace& h, const Reach& reach,
                                bool complement) const {
  const HalfSpace& known = half_spaces_[number];
  // b is half the unit normal.
  const Vec3 n = known.f.b * 2.0, m = h.f.b * 2.0;
  const double parting = length(complement ? n + m : n - m);
  if (!(parting < 1)) return false;
  const Vec3 foot = reach.center - m * dot(m, reach.center - h.center);
  return std::fabs(dot(n, foot - known.center)) + parting * reach.radius <=
         std::min(known_[number].tolerance, reach.tolerance);
}

bool HalfSpaceTable::same_curve(uint32_t number, const Reach& reach) const {
  const HalfSpace& known = half_spaces_[number];
  if (known_[number].is_ball != reach.is_ball) return false;
  const double tolerance = std::min(known_[number].tolerance, reach.tolerance);
  return std::ranges::all_of(reach.outline, [&](const Vec3& p) {
    const Vec3 q = p - known.center;
    const double gradient = 2 * length(K::quadric_half_gradient(known.f, q));
    return std::fabs(K::quadric_value(known.f, q)) <= tolerance * gradient && gradient > 0;
  });
}

bool HalfSpaceTable::same(uint32_t number, const HalfSpace& h, const Reach& reach,
                          bool complement) const {
  if (half_spaces_[number].is_plane() != h.is_plane()) return false;
  return h.is_plane() ? same_plane(number, h, reach, complement) : same_curve(number, reach);
}

uint32_t HalfSpaceTable::find(const HalfSpace& h, const Reach& reach, const Fingerprint& at,
                              bool complement) const {
  int64_t low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    const double v = complement ? -at.value[i] : at.value[i];
    low[i] = int64_t(std::floor((v - at.slack) / kBucketWidth));
    high[i] = int64_t(std::floor((v + at.slack) / kBucketWidth));
  }
  uint32_t best = kNone;
  int64_t cell[3];
  for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
    for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
      for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
        const auto found = head_.find(bucket(cell));
        if (found == head_.end()) continue;
        for (uint32_t i = found->second; i != kNone; i = next_[i])
          if (i < best && same(i, h, reach, complement)) best = i;
      }
  return best;
}

Literal HalfSpaceTable::add(const HalfSpace& h, const Reach& reach) {
  const Fingerprint at = fingerprint(h, reach);
  const uint32_t equal = find(h, reach, at, false);
  // Only planes come in complementary pairs: no primitive is the outside of a quadric.
  const uint32_t opposite = h.is_plane() ? find(h, reach, at, true) : kNone;
  if (opposite < equal) return Literal(opposite) * 2 + 1;
  if (equal != kNone) return Literal(equal) * 2;
  const uint32_t number = uint32_t(half_spaces_.size());
  half_spaces_.push_back(h);
  known_.push_back({reach.tolerance, reach.is_ball});
  int64_t cell[3];
  for (int i = 0; i < 3; ++i) cell[i] = int64_t(std::floor(at.value[i] / kBucketWidth));
  const auto [entry, fresh] = head_.try_emplace(bucket(cell), number);
  next_.push_back(fresh ? kNone : entry->second);
  entry->second = number;
  return Literal(number) * 2;
}

}  // namespace whittle

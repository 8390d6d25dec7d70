#include "lower/half_space_table.h"

#include <algorithm>

namespace whittle {
namespace {

using K = Kernels<double>;

constexpr uint32_t kNone = UINT32_MAX;

/// Unit cells of the indices in fingerprint units, and in those of normals.
constexpr double kCellsPerUnit = 64;

/// Normals of a group differ by no more than this in any coordinate: far above rounding, and so
/// little that across the region it is a small part of the tolerance.
constexpr double kSameNormal = 1e-9;

/// Frobenius norm of the second-degree part.
double curvature(const K::Quadric& f) {
  return std::sqrt(dot(f.diag, f.diag) + 2 * dot(f.off, f.off));
}

}  // namespace

HalfSpaceTable::HalfSpaceTable(double radius, double tolerance)
    : radius_(radius), step_(tolerance > 0 ? 4 * tolerance : 1) {}

HalfSpaceTable::Fingerprint HalfSpaceTable::wall_fingerprint(const HalfSpace& h,
                                                             const Reach& reach) const {
  // The values of f at three points in general position tell surfaces apart and hardly change
  // between nearly equal ones. They are taken relative to the second degree: equal over a small
  // primitive, two may part far away from it, but in those units by no more than in shape.
  // asinh tames the growth of what is far off.
  static constexpr Vec3 kProbes[3] = {
      {0.413, -0.287, 0.619}, {-0.531, 0.347, 0.271}, {0.179, 0.683, -0.443}};
  const double unit = curvature(h.f) * radius_ * radius_;
  Fingerprint r;
  for (size_t i = 0; i < 3; ++i)
    r.point[i] = std::asinh(K::quadric_value(h.f, kProbes[i] * radius_ - h.center) / unit);
  const double size = std::min({reach.width, reach.radius, radius_});
  r.slack = size > 0 ? 16 * reach.tolerance / size : 0;
  return r;
}

HalfSpaceTable::Fingerprint HalfSpaceTable::ball_fingerprint(const HalfSpace& h,
                                                             const Reach& reach) const {
  // Of two equal ellipsoids f of the one differs between opposite points p and q of the other by
  // 2 (p - q).M d, d the way between the middles, and may differ by no more than the tolerance
  // times the sum of the gradients there, 2 |M (p - q)|. With the three pairs on the axes of the
  // other that bounds |d| by sqrt(3) times the tolerance times the ratio of the longest semi-axis
  // to the shortest; sqrt(12) times the latter is above the width, and 1.2 times the outline's
  // reach above the former.
  Fingerprint r;
  for (size_t i = 0; i < 3; ++i) r.point[i] = std::asinh(h.center[int(i)] / radius_);
  const double size = reach.width * radius_;
  r.slack = size > 0 ? 16 * reach.tolerance * reach.ball_reach / size : 0;
  return r;
}

HalfSpaceTable::Fingerprint HalfSpaceTable::fingerprint(const HalfSpace& h,
                                                        const Reach& reach) const {
  Fingerprint r = reach.ball_reach > 0 ? ball_fingerprint(h, reach) : wall_fingerprint(h, reach);
  for (double& x : r.point) {
    // A model of 1e-320 overflows here: all that cannot be told apart any more goes to one place.
    x = std::fabs(x) < 1e3 ? x * kCellsPerUnit : 0;
  }
  r.slack *= kCellsPerUnit;
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
         std::min(tolerances_[number], reach.tolerance);
}

bool HalfSpaceTable::same_curve(uint32_t number, const Reach& reach, const Outline& outline) const {
  const HalfSpace& known = half_spaces_[number];
  const double tolerance = std::min(tolerances_[number], reach.tolerance);
  const auto lies_on_it = [&](const Vec3& p) {
    const Vec3 q = p - known.center;
    const double gradient = 2 * length(K::quadric_half_gradient(known.f, q));
    return std::fabs(K::quadric_value(known.f, q)) <= tolerance * gradient && gradient > 0;
  };
  return outline(
      [&](std::span<const Vec3> points) { return std::ranges::all_of(points, lies_on_it); });
}

uint32_t HalfSpaceTable::find_plane(const HalfSpace& h, const Reach& reach, bool complement) const {
  const Vec3 m = h.f.b * 2.0, n = complement ? -m : m;
  // Equal planes part by no more than the tolerance over the primitive.
  const double parting = std::min(1.0, reach.tolerance / reach.radius) + 2 * kSameNormal;
  PointIndex::Point low, high;
  for (size_t i = 0; i < 3; ++i) {
    low[i] = (n[int(i)] - parting) * kCellsPerUnit;
    high[i] = (n[int(i)] + parting) * kCellsPerUnit;
  }
  const Vec3 foot = reach.center - m * dot(m, reach.center - h.center);
  // The foot's distance from an equal plane, and what the group's normal adds to it.
  const double slack =
      (1.01 * reach.tolerance + 8 * kSameNormal * (length(foot) + reach.tolerance)) / step_;
  uint32_t best = kNone;
  groups_.visit(low, high, [&](uint32_t group, const auto&) {
    const double offset = dot(normals_[group], foot) / step_, of_group = double(group);
    planes_.visit({offset - slack, of_group, 0}, {offset + slack, of_group, 0},
                  [&](uint32_t number, const auto&) {
                    if (number < best && same_plane(number, h, reach, complement)) best = number;
                  });
  });
  return best;
}

void HalfSpaceTable::add_plane(const HalfSpace& h, uint32_t number) {
  const Vec3 n = h.f.b * 2.0;
  PointIndex::Point at, low, high;
  for (size_t i = 0; i < 3; ++i) {
    at[i] = n[int(i)] * kCellsPerUnit;
    low[i] = at[i] - kSameNormal * kCellsPerUnit, high[i] = at[i] + kSameNormal * kCellsPerUnit;
  }
  uint32_t group = kNone;
  groups_.visit(low, high, [&](uint32_t found, const auto&) { group = std::min(group, found); });
  if (group == kNone) {
    group = uint32_t(normals_.size());
    normals_.push_back(n);
    groups_.add(at, group);
  }
  const Vec3 nearest_to_origin = n * dot(n, h.center);
  planes_.add({dot(normals_[group], nearest_to_origin) / step_, double(group), 0}, number);
}

uint32_t HalfSpaceTable::find_curve(const HalfSpace& h, const Reach& reach,
                                    const Outline& outline) const {
  const Fingerprint at = fingerprint(h, reach);
  PointIndex::Point low, high;
  for (size_t i = 0; i < 3; ++i) low[i] = at.point[i] - at.slack, high[i] = at.point[i] + at.slack;
  uint32_t best = kNone;
  (reach.ball_reach > 0 ? balls_ : walls_).visit(low, high, [&](uint32_t number, const auto&) {
    if (number < best && same_curve(number, reach, outline)) best = number;
  });
  return best;
}

Literal HalfSpaceTable::add(const HalfSpace& h, const Reach& reach, const Outline& outline) {
  const uint32_t equal = h.is_plane() ? find_plane(h, reach, false) : find_curve(h, reach, outline);
  // Only planes come in complementary pairs: no primitive is the outside of a quadric.
  const uint32_t opposite = h.is_plane() ? find_plane(h, reach, true) : kNone;
  if (opposite < equal) return Literal(opposite) * 2 + 1;
  if (equal != kNone) return Literal(equal) * 2;
  const uint32_t number = uint32_t(half_spaces_.size());
  half_spaces_.push_back(h);
  tolerances_.push_back(reach.tolerance);
  if (h.is_plane())
    add_plane(h, number);
  else
    (reach.ball_reach > 0 ? balls_ : walls_).add(fingerprint(h, reach).point, number);
  return Literal(number) * 2;
}

}  // namespace whittle

#include "lower/half_space_table.h"

#include <algorithm>

#include "shape/extent.h"
#include "shape/wall.h"

namespace whittle {
namespace {

using K = Kernels<double>;

constexpr uint32_t kNone = UINT32_MAX;

/// Unit cells of the indices in fingerprint units, and in those of normals.
constexpr double kCellsPerUnit = 64;

/// With more groups of planes than this their normals are in finer cells, too.
constexpr size_t kManyGroups = 4096;

/// Normals of a group differ by no more than this in any coordinate: far above rounding, and so
/// little that across the region it is a small part of the tolerance.
constexpr double kSameNormal = 1e-9;

Vec3 middle_of(std::span<const Vec3> ring) {
  Vec3 sum;
  for (const Vec3& p : ring) sum += p;
  return sum / double(ring.size());
}

/// Whether two neighbouring rings of an outline lie on either nappe of the double cone f = 0, on
/// which the outline is. Then the apex is between them: along the axis f slopes the other way at
/// the other ring, and from ring to ring by more than across the ring's radius. (The slopes along a
/// cylinder are rounding.)
bool is_on_both_nappes(const HalfSpace& h, std::span<const Vec3> outline) {
  for (size_t i = 0; i + 2 * kRingPoints <= outline.size(); i += kRingPoints) {
    const auto ring = outline.subspan(i, kRingPoints), next = outline.subspan(i + kRingPoints);
    const Vec3 middle = middle_of(ring), along = middle_of(next.first(kRingPoints)) - middle;
    const Vec3 gradient = K::quadric_half_gradient(h.f, ring[0] - h.center);
    const double here = dot(gradient, along);
    const double there = dot(K::quadric_half_gradient(h.f, next[0] - h.center), along);
    if (here * there < 0 && std::fabs(here) > std::fabs(dot(gradient, ring[0] - middle)))
      return true;
  }
  return false;
}

}  // namespace

HalfSpaceTable::HalfSpaceTable(double radius, double tolerance)
    : radius_(radius), step_(tolerance > 0 ? 4 * tolerance : 1) {}

Fingerprint HalfSpaceTable::place_of(const HalfSpace& h, const Reach& reach) const {
  Fingerprint r = fingerprint(h, reach.ball_reach > 0, reach, radius_);
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
  return outline([&](std::span<const Vec3> points) {
    return std::ranges::all_of(points, lies_on_it) &&
           (reach.ball_reach > 0 || !is_on_both_nappes(known, points));
  });
}

template <class Visit>
void HalfSpaceTable::visit_planes(PointIndex Shelves::*shelf, const HalfSpace& h,
                                  const Reach& reach, bool complement, const Visit& visit) const {
  const Vec3 m = h.f.b * 2.0, n = complement ? -m : m;
  // Equal planes part by no more than the tolerance over the primitive.
  const double parting = std::min(1.0, reach.tolerance / reach.radius) + 2 * kSameNormal;
  const Vec3 foot = reach.center - m * dot(m, reach.center - h.center);
  // The foot's distance from an equal plane, and what the group's normal adds to it.
  const double slack =
      (1.01 * reach.tolerance + 8 * kSameNormal * (length(foot) + reach.tolerance)) / step_;
  bool goes_on = true;
  visit_groups(n, parting, [&](uint32_t group) {
    const double offset = dot(normals_[group], foot) / step_, of_group = double(group);
    (planes_.*shelf)
        .visit({offset - slack, of_group, 0}, {offset + slack, of_group, 0}, [&](uint32_t number) {
          return goes_on = visit(Literal(number) * 2 + (complement ? 1 : 0));
        });
    return goes_on;
  });
}

template <class Visit>
void HalfSpaceTable::visit_near(PointIndex Shelves::*shelf, const HalfSpace& h, const Reach& reach,
                                const Fingerprint& at, const Visit& visit) const {
  if (h.is_plane()) {
    // Only planes come in complementary pairs: no primitive is the outside of a quadric.
    visit_planes(shelf, h, reach, false, visit);
    visit_planes(shelf, h, reach, true, visit);
    return;
  }
  PointIndex::Point low, high;
  for (size_t i = 0; i < 3; ++i) low[i] = at.point[i] - at.slack, high[i] = at.point[i] + at.slack;
  const Shelves& shelves = reach.ball_reach > 0 ? balls_ : walls_;
  (shelves.*shelf).visit(low, high, [&](uint32_t number) { return visit(Literal(number) * 2); });
}

template <class Visit>
void HalfSpaceTable::visit_groups(Vec3 n, double parting, const Visit& visit) const {
  size_t level = normals_.size() > kManyGroups ? kNormalCellsPerUnit.size() - 1 : 0;
  while (level > 0 && parting * kNormalCellsPerUnit[level] > 0.5) --level;
  const double scale = kNormalCellsPerUnit[level];
  PointIndex::Point low, high;
  for (size_t i = 0; i < 3; ++i) {
    low[i] = (n[int(i)] - parting) * scale;
    high[i] = (n[int(i)] + parting) * scale;
  }
  groups_[level].visit(low, high, visit);
}

uint32_t HalfSpaceTable::group_of(Vec3 n) {
  uint32_t group = kNone;
  visit_groups(n, kSameNormal, [&](uint32_t found) {
    group = std::min(group, found);
    return true;
  });
  if (group != kNone) return group;
  const auto put_in = [&](size_t level, uint32_t i) {
    const double scale = kNormalCellsPerUnit[level];
    groups_[level].add({normals_[i].x * scale, normals_[i].y * scale, normals_[i].z * scale}, i);
  };
  group = uint32_t(normals_.size());
  normals_.push_back(n);
  put_in(0, group);
  if (normals_.size() <= kManyGroups) return group;
  const uint32_t first = normals_.size() == kManyGroups + 1 ? 0 : group;
  for (size_t level = 1; level < kNormalCellsPerUnit.size(); ++level)
    for (uint32_t i = first; i <= group; ++i) put_in(level, i);
  return group;
}

void HalfSpaceTable::put(const HalfSpace& h, uint32_t number, bool is_ball, const Fingerprint& at) {
  if (!h.is_plane()) {
    (is_ball ? balls_ : walls_).of(crowded_[number]).add(at.point, number);
    return;
  }
  const Vec3 n = h.f.b * 2.0, nearest_to_origin = n * dot(n, h.center);
  const uint32_t group = group_of(n);
  const double offset = dot(normals_[group], nearest_to_origin) / step_;
  planes_.of(crowded_[number]).add({offset, double(group), 0}, number);
}

Literal HalfSpaceTable::add(const HalfSpace& h, const Reach& reach, const Reach& equal,
                            const Outline& outline) {
  const Fingerprint at = h.is_plane() ? Fingerprint{} : place_of(h, reach);
  Fingerprint at_equal = at;
  if (reach.tolerance > 0) at_equal.slack *= equal.tolerance / reach.tolerance;

  // In a crowd there can be very many: of them only those that may be equal are looked at.
  near_.clear();
  const auto remember = [this](Literal other) {
    near_.push_back(other);
    return true;
  };
  visit_near(&Shelves::lonely, h, reach, at, remember);
  visit_near(&Shelves::crowded, h, equal, at_equal, remember);
  Literal found = Literal(half_spaces_.size()) * 2;
  for (const Literal other : near_) {
    if (other >> 1 < found >> 1 && (h.is_plane() ? same_plane(other >> 1, h, equal, other & 1)
                                                 : same_curve(other >> 1, equal, outline)))
      found = other;
  }

  const uint32_t number = found >> 1;
  const bool is_new = number == half_spaces_.size();
  if (is_new) {
    half_spaces_.push_back(h);
    tolerances_.push_back(equal.tolerance);
    crowded_.push_back(false);
  }
  const auto crowds = [this, number](Literal other) {
    if (other >> 1 != number) crowded_[other >> 1] = crowded_[number] = true;
    return !crowded_[number];
  };
  for (const Literal other : near_) crowds(other);
  if (!crowded_[number]) visit_near(&Shelves::crowded, h, reach, at, crowds);
  if (is_new) put(h, number, reach.ball_reach > 0, at);
  return found;
}

}  // namespace whittle

#include "lower/half_space_table.h"

#include <algorithm>

#include "model/extent.h"

namespace whittle {
namespace {

using K = Kernels<double>;

constexpr uint32_t kNone = UINT32_MAX;

/// Unit cells of the indices in fingerprint units, and in those of normals.
constexpr double kCellsPerUnit = 64;

/// With more groups of planes than this their normals are in finer cells, too.
constexpr size_t kManyGroups = 4096;

/// Each has eight times the slack of the one before.
constexpr size_t kMostSieves = 5;

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
  // asinh tames the growth of what is far off; the slack holds for walls that come within a few
  // radii, and of others nothing is seen.
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

void HalfSpaceTable::put_plane(uint32_t number) {
  if (is_put_[number]) return;
  is_put_[number] = true;
  const HalfSpace& h = half_spaces_[number];
  const Vec3 n = h.f.b * 2.0, nearest_to_origin = n * dot(n, h.center);
  const uint32_t group = group_of(n);
  const double offset = dot(normals_[group], nearest_to_origin) / step_;
  planes_.of(crowded_[number]).add({offset, double(group), 0}, number);
}

void HalfSpaceTable::put(const HalfSpace& h, uint32_t number, bool is_ball, const Fingerprint& at) {
  if (h.is_plane())
    put_plane(number);
  else
    (is_ball ? balls_ : walls_).of(crowded_[number]).add(at.point, number);
}

PlanePlace HalfSpaceTable::place_of(const HalfSpace& h) const {
  const Vec3 n = h.f.b * 2.0;
  return {n, dot(n, h.center)};
}

/// The finest sieve in which nothing near is passed over; null if there is none. Those that are
/// asked for the first time are made.
PlaneSieve* HalfSpaceTable::sieve_for(double offset_slack, double normal_slack) {
  const double unit = std::max(step_, 1e-7 * radius_);
  double slack = 2 * unit;
  for (size_t i = 0; i < kMostSieves; ++i, slack *= 8) {
    if (!(offset_slack <= slack && normal_slack <= slack / radius_)) continue;
    for (PlaneSieve& sieve : sieves_)
      if (sieve.offset_slack() == slack) return &sieve;
    PlaneSieve& made = sieves_.emplace_back(slack, slack / radius_);
    for (uint32_t number = 0; number < half_spaces_.size(); ++number) {
      if (!half_spaces_[number].is_plane()) continue;
      if (!made.add(place_of(half_spaces_[number]), number)) put_plane(number);
    }
    return &made;
  }
  return nullptr;
}

void HalfSpaceTable::add_to_sieves(uint32_t number) {
  const PlanePlace place = place_of(half_spaces_[number]);
  for (PlaneSieve& sieve : sieves_)
    if (!sieve.add(place, number)) put_plane(number);
}

/// Whether no plane is near this one, as visit_planes() sees it. Else those that are have been put
/// where they are found.
bool HalfSpaceTable::stands_alone(const HalfSpace& h, const Reach& reach) {
  if (puts_all_) return false;
  const PlanePlace place = place_of(h);
  // As there, and what the normals of groups add: the sieves know the planes' own.
  const double parting = std::min(1.0, reach.tolerance / reach.radius) + 4 * kSameNormal;
  const Vec3 foot = reach.center - place.n * dot(place.n, reach.center - h.center);
  const double slack = 1.01 * reach.tolerance + parting * length(foot) +
                       16 * kSameNormal * (length(foot) + radius_ + reach.tolerance);
  PlaneSieve* const sieve = sieve_for(slack, parting);
  if (sieve != nullptr)
    return !sieve->take_near(place, [this](uint32_t number) { put_plane(number); });
  for (uint32_t number = 0; number < half_spaces_.size(); ++number)
    if (half_spaces_[number].is_plane()) put_plane(number);
  puts_all_ = true;
  sieves_.clear();
  return false;
}

uint32_t HalfSpaceTable::add_new(const HalfSpace& h, double tolerance) {
  half_spaces_.push_back(h);
  tolerances_.push_back(tolerance);
  crowded_.push_back(false);
  is_put_.push_back(false);
  return uint32_t(half_spaces_.size() - 1);
}

Literal HalfSpaceTable::add(const HalfSpace& h, const Reach& reach, const Reach& equal,
                            const Outline& outline) {
  if (h.is_plane() && stands_alone(h, reach)) {
    const uint32_t number = add_new(h, equal.tolerance);
    add_to_sieves(number);
    return Literal(number) * 2;
  }
  const Fingerprint at = h.is_plane() ? Fingerprint{} : fingerprint(h, reach);
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
  if (is_new) add_new(h, equal.tolerance);
  const auto crowds = [this, number](Literal other) {
    if (other >> 1 != number) crowded_[other >> 1] = crowded_[number] = true;
    return !crowded_[number];
  };
  for (const Literal other : near_) crowds(other);
  if (!crowded_[number]) visit_near(&Shelves::crowded, h, reach, at, crowds);
  if (is_new) put(h, number, reach.ball_reach > 0, at);
  if (is_new && h.is_plane()) add_to_sieves(number);
  return found;
}

}  // namespace whittle

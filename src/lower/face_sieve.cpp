#include "lower/face_sieve.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace whittle {
namespace {

/// Faces that are looked at in one go, so that what they need of the table is fetched meanwhile.
constexpr size_t kBatch = 32;
constexpr size_t kEach = size_t(1) << 12;
/// Slots of a table of cells for each face in it; of one of lists.
constexpr size_t kManySlots = 16, kFewSlots = 2;
/// Of the cells of a level to those of the one before.
constexpr double kLevelRatio = 8;
/// In a crowd a face that has met so many others counts as near one.
constexpr size_t kMostMet = 256;
constexpr uint32_t kNone = UINT32_MAX;

/// A coordinate that is not used: the next cells are not near.
constexpr double kMidCell = 0.5;

/// The cell that a place is in.
CellPlace<4> cell_of(const std::array<double, 4>& place) {
  CellPlace<4> cell;
  for (size_t i = 0; i < cell.size(); ++i) cell[i] = cell_coordinate(place[i]);
  return cell;
}

/// Positive if a plane is turned as it is kept. The direction is one that no model favours.
double turned(Vec3 n) {
  return dot(n, Vec3{0.8117, 0.4733, 0.3421});
}

/// Whether a's plane lies on b's over the reach of a's primitive, turned either way.
bool may_be_one_over(const HalfSpace& a, const Reach& reach, const HalfSpace& b) {
  const Vec3 n = a.f.b * 2.0, m = b.f.b * 2.0;
  const Vec3 foot = reach.center - n * dot(n, reach.center - a.center);
  // A little more than the tolerance, as equal ones differ by a little. What is no number is near.
  const double off = std::fabs(dot(m, foot - b.center)), most = 1.01 * reach.tolerance;
  if (off > most) return false;
  const double parting = std::sqrt(std::min(dot(n - m, n - m), dot(n + m, n + m)));
  return !(off + parting * reach.radius > most);
}

bool may_be_one(const HalfSpace& a, const Reach& a_reach, const HalfSpace& b,
                const Reach& b_reach) {
  return may_be_one_over(a, a_reach, b) || may_be_one_over(b, b_reach, a);
}

bool may_be_one(const Fingerprint& a, const Fingerprint& b) {
  const double slack = std::max(a.slack, b.slack);
  for (size_t i = 0; i < a.point.size(); ++i)
    if (std::fabs(a.point[i] - b.point[i]) > slack) return false;
  return true;
}

/// A hash table without keys: what has one slot is together.
template <class Slot>
class SlotTable {
 public:
  SlotTable(size_t slots, Slot empty, const Workers* workers) : slots_(std::bit_ceil(slots)) {
    constexpr size_t kSlotsEach = size_t(1) << 18;
    for_parts(workers, slots_.size(), kSlotsEach, [&](size_t first, size_t last, size_t) {
      std::fill(slots_.begin() + std::ptrdiff_t(first), slots_.begin() + std::ptrdiff_t(last),
                empty);
    });
  }
  size_t index(uint64_t hash) const { return size_t(hash) & (slots_.size() - 1); }
  std::atomic_ref<Slot> operator[](size_t index) { return std::atomic_ref<Slot>(slots_[index]); }
  Slot at(uint64_t hash) const { return slots_[index(hash)]; }
  void prefetch(size_t index) const { __builtin_prefetch(&slots_[index], 1); }

 private:
  UninitializedVector<Slot> slots_;
};

/// Calls body(chunk, first, last) for chunks of 0 <= i < n, and returns what the chunks have put
/// into their lists, in order.
template <class Body>
std::vector<uint32_t> for_chunks(const Workers* workers, size_t n, const Body& body) {
  std::vector<std::vector<uint32_t>> found((n + kEach - 1) / kEach);
  for_parts(workers, found.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t chunk = first; chunk < last; ++chunk)
      body(chunk * kEach, std::min(n, (chunk + 1) * kEach), found[chunk]);
  });
  std::vector<uint32_t> all;
  for (const std::vector<uint32_t>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

FaceSieve::FaceSieve(double radius, double tolerance, size_t faces)
    : radius_(radius),
      plane_unit_(std::max(8 * tolerance, 1e-9 * radius)),
      curve_unit_(16 * std::max(tolerance / radius, 1e-12)),
      known_(faces) {
  double slacks = 1;
  for (double& cells : cells_) {
    cells = 1 / (kWidth * slacks);
    slacks *= kLevelRatio;
  }
}

uint8_t FaceSieve::level_for(double slack_in_units) {
  uint8_t level = 0;
  for (double slack = 1; level < kLastLevel && !(slack_in_units <= slack); slack *= kLevelRatio)
    ++level;
  return level;
}

void FaceSieve::set(uint32_t face, const HalfSpace& h, const Reach& reach) {
  Kind kind = kPlane;
  double slack = 0;
  if (h.is_plane()) {
    // Equal planes part by no more than the tolerance over the primitive. That is where they are
    // near each other, but they are told apart by their distances from the origin.
    const Vec3 n = h.f.b * 2.0;
    const double parting = 1.01 * std::min(1.0, reach.tolerance / reach.radius) + 1e-14;
    const Vec3 foot = reach.center - n * dot(n, reach.center - h.center);
    const double away = 1.01 * reach.tolerance + parting * length(foot) + 1e-14 * radius_;
    slack = std::max(away, parting * radius_) / plane_unit_;
  } else {
    kind = reach.ball_reach > 0 ? kBall : kWall;
    slack = fingerprint_slack(reach, radius_) / curve_unit_;
  }
  known_[face] = uint8_t(level_for(slack) | kind << kKindShift);
}

FaceSieve::Place FaceSieve::place_of(const HalfSpace& h, Kind kind, uint8_t level) const {
  if (level == kLastLevel) return {kMidCell, kMidCell, kMidCell, kMidCell};
  const double cells = cells_[level];
  if (kind == kPlane) {
    // Either side may be meant.
    const Vec3 n = turned(h.f.b) < 0 ? h.f.b * -2.0 : h.f.b * 2.0;
    const double scale = cells / plane_unit_, scale_of_normals = scale * radius_;
    return {n.x * scale_of_normals, n.y * scale_of_normals, n.z * scale_of_normals,
            dot(n, h.center) * scale};
  }
  const double scale = cells / curve_unit_;
  if (kind == kWall) {
    const PointIndex::Point point = fingerprint_point(h, false, radius_);
    return {point[0] * scale, point[1] * scale, point[2] * scale, kMidCell};
  }
  // Equal balls' middles are as near as their fingerprints. What is far off is all in one place.
  constexpr double kFar = 8;
  const auto at = [&](double x) { return std::clamp(x / radius_, -kFar, kFar) * scale; };
  return {at(h.center.x), at(h.center.y), at(h.center.z), kMidCell};
}

uint64_t FaceSieve::hash_of_cell(const Cell& cell, Kind kind, uint8_t level) {
  const uint64_t hash = (hash_of(cell) + uint64_t(level * 4 + kind)) * 0x9e3779b97f4a7c15ull;
  return hash ^ hash >> 32;
}

uint64_t FaceSieve::hash_at(const HalfSpace& h, Kind kind, uint8_t level) const {
  return hash_of_cell(cell_of(place_of(h, kind, level)), kind, level);
}

bool FaceSieve::is_between_turns(const HalfSpace& h, uint8_t level) const {
  const double slack = plane_unit_ / (radius_ * kWidth * cells_[level]);
  return std::fabs(turned(h.f.b * 2.0)) <= 2 * slack;
}

bool FaceSieve::reaches_out(const HalfSpace& h, const Place& place, const Cell& cell, Kind kind,
                            uint8_t level) const {
  if (level == kLastLevel) return false;
  for (size_t i = 0; i < place.size(); ++i) {
    // A little more than the slack: this is rounded in another way.
    const double above = place[i] - double(cell[i]);
    if (!(above > 1.01 / kWidth && above < 1 - 1.01 / kWidth)) return true;
  }
  return kind == kPlane && is_between_turns(h, level);
}

template <class Visit>
void FaceSieve::visit_near(const HalfSpace& h, Kind kind, uint8_t level, const Visit& visit) const {
  Place place = place_of(h, kind, level);
  const bool both = kind == kPlane && level < kLastLevel && is_between_turns(h, level);
  for (int turn = 0; turn <= int(both); ++turn) {
    Cell from, to;
    for (size_t i = 0; i < from.size(); ++i) {
      from[i] = cell_coordinate(place[i] - 1 / kWidth);
      to[i] = cell_coordinate(place[i] + 1 / kWidth);
    }
    Cell cell;
    for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
      for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
        for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
          for (cell[3] = from[3]; cell[3] <= to[3]; ++cell[3])
            if (!visit(hash_of_cell(cell, kind, level))) return;
    for (double& x : place) x = -x;
  }
}

template <class Visit>
void FaceSieve::visit_coarser(uint8_t known, const Visit& visit) const {
  const unsigned levels = levels_[kind_of(known)];
  for (unsigned level = level_of(known) + 1u; levels >> level != 0; ++level)
    if (levels >> level & 1) visit(uint8_t(level));
}

/// How many levels a face may be in.
size_t FaceSieve::most_levels() const {
  int most = 1;
  for (const uint16_t levels : levels_) most = std::max(most, std::popcount(levels));
  return size_t(most);
}

/// By who is in which cells alone. Marks are set by anybody in any order, and there is no telling
/// who set them: so the faces are the same with any number of threads.
std::vector<uint32_t> FaceSieve::sift(std::span<const HalfSpace> half_spaces,
                                      const Workers* workers) {
  const size_t n = known_.size();
  SlotTable<uint8_t> slots(kManySlots * n * most_levels(), 0, workers);
  const auto mark = [&slots](size_t slot, uint8_t bit) {
    return slots[slot].fetch_or(bit, std::memory_order_relaxed);
  };
  const auto look = [&slots](size_t slot) { return slots[slot].load(std::memory_order_relaxed); };
  UninitializedVector<size_t> own(n);  // slots
  for_chunks(workers, n, [&](size_t first, size_t last, std::vector<uint32_t>&) {
    for (size_t batch = first; batch < last; batch += kBatch) {
      const size_t end = std::min(last, batch + kBatch);
      for (size_t k = batch; k < end; ++k) {
        const HalfSpace& h = half_spaces[k];
        const Kind kind = kind_of(known_[k]);
        const uint8_t level = level_of(known_[k]);
        const Place place = place_of(h, kind, level);
        const Cell cell = cell_of(place);
        if (reaches_out(h, place, cell, kind, level)) known_[k] |= kReachesOut;
        own[k] = slots.index(hash_of_cell(cell, kind, level));
        slots.prefetch(own[k]);
      }
      for (size_t k = batch; k < end; ++k) {
        if (mark(own[k], kResident) & kResident) mark(own[k], kMore);
        visit_coarser(known_[k], [&](uint8_t level) {
          mark(slots.index(hash_at(half_spaces[k], kind_of(known_[k]), level)), kGuest);
        });
      }
    }
  });
  for_chunks(workers, n, [&](size_t first, size_t last, std::vector<uint32_t>&) {
    for (size_t k = first; k < last; ++k) {
      uint8_t& known = known_[k];
      if (!(known & kReachesOut)) continue;
      visit_near(half_spaces[k], kind_of(known), level_of(known), [&](uint64_t hash) {
        const size_t slot = slots.index(hash);
        if (slot == own[k] || !(look(slot) & (kResident | kGuest))) return true;
        mark(slot, kDisturbed);
        known |= kHasOthers;
        return true;
      });
    }
  });
  return for_chunks(workers, n, [&](size_t first, size_t last, std::vector<uint32_t>& found) {
    for (size_t k = first; k < last; ++k) {
      const uint8_t known = known_[k];
      bool any = (known & kHasOthers) || (look(own[k]) & (kMore | kGuest | kDisturbed));
      visit_coarser(known, [&](uint8_t level) {
        const size_t slot = slots.index(hash_at(half_spaces[k], kind_of(known), level));
        any = any || (look(slot) & (kResident | kDisturbed));
      });
      if (any) found.push_back(uint32_t(k));
    }
  });
}

/// Whether two faces of a kind may be one over the reach of either's primitive.
std::vector<uint32_t> FaceSieve::look_closely(std::span<const HalfSpace> half_spaces,
                                              const ReachOf& reach_of,
                                              std::span<const uint32_t> some,
                                              const Workers* workers) const {
  // Lists by cell. Guests are in lists of their own: they do not look for one another.
  const size_t n = some.size(), guests_each = most_levels() - 1;
  SlotTable<uint32_t> residents(kFewSlots * n, kNone, workers),
      guests(kFewSlots * n * guests_each + 1, kNone, workers);
  UninitializedVector<uint32_t> next_resident(n), next_guest(n * guests_each);
  // Crowds have many more pairs than faces.
  UninitializedVector<Fingerprint> fingerprints(n);
  for_chunks(workers, n, [&](size_t first, size_t last, std::vector<uint32_t>&) {
    for (size_t k = first; k < last; ++k) {
      const HalfSpace& h = half_spaces[some[k]];
      const uint8_t known = known_[some[k]];
      const Kind kind = kind_of(known);
      if (kind != kPlane)
        fingerprints[k] = fingerprint(h, kind == kBall, reach_of(some[k]), radius_);
      const auto put = [](SlotTable<uint32_t>& table, uint64_t hash, size_t place) {
        return table[table.index(hash)].exchange(uint32_t(place), std::memory_order_relaxed);
      };
      next_resident[k] = put(residents, hash_at(h, kind, level_of(known)), k);
      size_t guest = k * guests_each;
      visit_coarser(known, [&](uint8_t level) {
        next_guest[guest] = put(guests, hash_at(h, kind, level), guest);
        ++guest;
      });
    }
  });
  return for_chunks(workers, n, [&](size_t first, size_t last, std::vector<uint32_t>& found) {
    for (size_t k = first; k < last; ++k) {
      const HalfSpace& h = half_spaces[some[k]];
      const uint8_t known = known_[some[k]];
      const Kind kind = kind_of(known);
      const Reach& reach = reach_of(some[k]);
      size_t met = 0;
      bool any = false;
      const auto meet = [&](size_t other) {
        if (other == k || kind_of(known_[some[other]]) != kind) return;
        any =
            ++met > kMostMet ||
            (kind == kPlane ? may_be_one(h, reach, half_spaces[some[other]], reach_of(some[other]))
                            : may_be_one(fingerprints[k], fingerprints[other]));
      };
      const auto meet_residents = [&](uint64_t hash) {
        for (uint32_t i = residents.at(hash); i != kNone && !any; i = next_resident[i]) meet(i);
        return !any;
      };
      visit_near(h, kind, level_of(known), [&](uint64_t hash) {
        for (uint32_t i = guests.at(hash); i != kNone && !any; i = next_guest[i])
          meet(i / guests_each);
        return meet_residents(hash);
      });
      visit_coarser(known, [&](uint8_t level) {
        if (!any) visit_near(h, kind, level, meet_residents);
      });
      if (any) found.push_back(some[k]);
    }
  });
}

std::vector<uint32_t> FaceSieve::with_others(std::span<const HalfSpace> half_spaces,
                                             const ReachOf& reach_of, const Workers* workers) {
  for (const uint8_t known : known_) levels_[kind_of(known)] |= uint16_t(1 << level_of(known));
  return look_closely(half_spaces, reach_of, sift(half_spaces, workers), workers);
}

}  // namespace whittle

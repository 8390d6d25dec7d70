#include "lower/face_sieve.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace whittle {
namespace {

/// Faces that are looked at in one go, so that what they need of the table is fetched meanwhile.
constexpr size_t kBatch = 32;
constexpr size_t kEach = 1 << 13;
/// Slots of the table for each face.
constexpr size_t kSlotsPerFace = 8, kMostSlots = size_t(1) << 32;
/// Passes end when fewer are left than this, or hardly fewer than before.
constexpr size_t kFew = 64;
constexpr int kMostPasses = 4;

/// Positive if a plane is turned as it is kept. The direction is one that no model favours.
double turned(Vec3 n) {
  return dot(n, Vec3{0.8117, 0.4733, 0.3421});
}

}  // namespace

FaceSieve::FaceSieve(double radius, double tolerance, size_t faces)
    : radius_(radius),
      plane_unit_(std::max(8 * tolerance, 1e-9 * radius)),
      curve_unit_(16 * std::max(tolerance / radius, 1e-12)),
      known_(faces) {}

uint8_t FaceSieve::level_for(double slack_in_units) {
  uint8_t level = 0;
  for (double slack = 1; level < kLastLevel && !(slack_in_units <= slack); slack *= 8) ++level;
  return level;
}

void FaceSieve::set(uint32_t face, const HalfSpace& h, const Reach& reach) {
  Kind kind = kPlane;
  double slack = 0;
  if (h.is_plane()) {
    // Equal planes part by no more than the tolerance over the primitive. There they are so near
    // as it allows, but their distance is told from that of the origin.
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
  if (level == kLastLevel) return {};
  const double cells = 1 / (kWidth * std::ldexp(1.0, 3 * level));
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
    return {point[0] * scale, point[1] * scale, point[2] * scale, 0};
  }
  // What is far off is all in one place.
  constexpr double kFar = 8;
  const auto at = [&](double x) { return std::clamp(x / radius_, -kFar, kFar) * scale; };
  return {at(h.center.x), at(h.center.y), at(h.center.z), 0};
}

size_t FaceSieve::slot_of(const Cell& cell, Kind kind, uint8_t level) const {
  const uint64_t hash = hash_of(cell) + salt_ + uint64_t(level * 4 + kind);
  return size_t(hash * 0x9e3779b97f4a7c15ull >> 32) & (slots_.size() - 1);
}

FaceSieve::Cell FaceSieve::cell_of(const Place& place) {
  Cell cell;
  for (size_t i = 0; i < cell.size(); ++i) cell[i] = cell_coordinate(place[i]);
  return cell;
}

bool FaceSieve::is_between_turns(const HalfSpace& h, uint8_t level) const {
  const double slack = plane_unit_ / radius_ * std::ldexp(1.0, 3 * level);
  return std::fabs(turned(h.f.b * 2.0)) <= 2 * slack;
}

bool FaceSieve::reaches_out(const HalfSpace& h, const Place& place, Kind kind,
                            uint8_t level) const {
  if (level == kLastLevel) return false;
  const auto stays = [](double x) {
    return cell_coordinate(x - 1 / kWidth) == cell_coordinate(x + 1 / kWidth);
  };
  return !std::ranges::all_of(place, stays) || (kind == kPlane && is_between_turns(h, level));
}

template <class Visit>
void FaceSieve::visit_near(const Place& place, Kind kind, uint8_t level, const Visit& visit) const {
  Cell from, to;
  for (size_t i = 0; i < from.size(); ++i) {
    from[i] = cell_coordinate(place[i] - 1 / kWidth);
    to[i] = cell_coordinate(place[i] + 1 / kWidth);
  }
  Cell cell;
  for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
    for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
      for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
        for (cell[3] = from[3]; cell[3] <= to[3]; ++cell[3]) visit(slot_of(cell, kind, level));
}

template <class Visit>
void FaceSieve::visit_coarser(const HalfSpace& h, uint8_t known, const Visit& visit) const {
  const Kind kind = kind_of(known);
  for (unsigned levels = unsigned(levels_[kind]) >> (level_of(known) + 1),
                level = level_of(known) + 1u;
       levels != 0; levels >>= 1, ++level)
    if (levels & 1)
      visit(slot_of(cell_of(place_of(h, kind, uint8_t(level))), kind, uint8_t(level)));
}

void FaceSieve::clear_table(size_t faces, const Workers* workers) {
  int most_levels = 1;
  for (const uint16_t levels : levels_) most_levels = std::max(most_levels, std::popcount(levels));
  const size_t slots = std::bit_ceil(kSlotsPerFace * faces * size_t(most_levels));
  slots_.resize(std::min(slots, kMostSlots));
  for_parts(workers, slots_.size(), kEach, [&](size_t first, size_t last, size_t) {
    std::fill(slots_.begin() + std::ptrdiff_t(first), slots_.begin() + std::ptrdiff_t(last),
              uint8_t(0));
  });
}

std::vector<uint32_t> FaceSieve::sift(std::span<const HalfSpace> half_spaces,
                                      const std::vector<uint32_t>* some, const Workers* workers) {
  const size_t n = some != nullptr ? some->size() : known_.size();
  const auto face_at = [some](size_t k) { return some != nullptr ? (*some)[k] : uint32_t(k); };
  const size_t chunks = (n + kEach - 1) / kEach;
  const auto for_chunks = [&](const auto& body) {
    for_parts(workers, chunks, 1, [&](size_t first, size_t last, size_t) {
      for (size_t chunk = first; chunk < last; ++chunk)
        body(chunk, chunk * kEach, std::min(n, (chunk + 1) * kEach));
    });
  };
  clear_table(n, workers);
  UninitializedVector<uint32_t> own(n);  // slots
  for_chunks([&](size_t, size_t first, size_t last) {
    for (size_t batch = first; batch < last; batch += kBatch) {
      const size_t end = std::min(last, batch + kBatch);
      for (size_t k = batch; k < end; ++k) {
        uint8_t& known = known_[face_at(k)];
        const HalfSpace& h = half_spaces[face_at(k)];
        const Kind kind = kind_of(known);
        const uint8_t level = level_of(known);
        const Place place = place_of(h, kind, level);
        known &= uint8_t(~(kReachesOut | kHasOthers));
        if (reaches_out(h, place, kind, level)) known |= kReachesOut;
        own[k] = uint32_t(slot_of(cell_of(place), kind, level));
        __builtin_prefetch(&slots_[own[k]], 1);
      }
      for (size_t k = batch; k < end; ++k) {
        if (mark(own[k], kResident) & kResident) mark(own[k], kMore);
        const uint32_t face = face_at(k);
        visit_coarser(half_spaces[face], known_[face], [&](size_t slot) { mark(slot, kGuest); });
      }
    }
  });
  for_chunks([&](size_t, size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      uint8_t& known = known_[face_at(k)];
      if (!(known & kReachesOut)) continue;
      const HalfSpace& h = half_spaces[face_at(k)];
      const Kind kind = kind_of(known);
      const auto disturb = [&](size_t slot) {
        if (slot == own[k] || !(look(slot) & (kResident | kGuest))) return;
        mark(slot, kDisturbed);
        known |= kHasOthers;
      };
      Place place = place_of(h, kind, level_of(known));
      visit_near(place, kind, level_of(known), disturb);
      if (kind != kPlane || !is_between_turns(h, level_of(known))) continue;
      for (double& x : place) x = -x;
      visit_near(place, kind, level_of(known), disturb);
    }
  });
  std::vector<std::vector<uint32_t>> found(chunks);
  for_chunks([&](size_t chunk, size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t face = face_at(k);
      const uint8_t known = known_[face];
      bool any = (known & kHasOthers) || (look(own[k]) & (kMore | kGuest | kDisturbed));
      visit_coarser(half_spaces[face], known, [&](size_t slot) {
        any = any || (look(slot) & (kResident | kDisturbed));
      });
      if (any) found[chunk].push_back(face);
    }
  });
  std::vector<uint32_t> all;
  for (const std::vector<uint32_t>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<uint32_t> FaceSieve::with_others(std::span<const HalfSpace> half_spaces,
                                             const Workers* workers) {
  for (const uint8_t known : known_) levels_[kind_of(known)] |= uint16_t(1 << level_of(known));
  std::vector<uint32_t> found = sift(half_spaces, nullptr, workers);
  // Others that a hash made up are others by another hash.
  for (int pass = 1; pass < kMostPasses && found.size() > kFew; ++pass) {
    salt_ += 0x632be59bd9b4e019ull;
    std::vector<uint32_t> left = sift(half_spaces, &found, workers);
    const bool goes_on = left.size() < found.size() - found.size() / 4;
    found.swap(left);
    if (!goes_on) break;
  }
  return found;
}

}  // namespace whittle

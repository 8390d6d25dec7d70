#include "trace/cpu/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/instruction_set.h"

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/cpu/lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/cpu/crossings.h"
#include "trace/cpu/leaf-inl.h"
#include "trace/cpu/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

/// Where a cell's edge is shorter than this many widths of the tile, what it is to its rays is
/// worked out for each.
constexpr double kExact = 1;

/// A cell by the planes where rays of one octant enter and leave it.
struct Planes {
  double enter[3], leave[3];
};

/// What is true of all rays that walk together; coordinates of axes along which they go backward
/// are negated, so that along every axis they go forward.
struct Bounds {
  double low_origin[3], high_origin[3];
  double low_inverse[3], high_inverse[3];
  double t0, t1;  ///< the first start and the last end
};

/// Walks a tile through the cells, front to back.
class Walk {
 public:
  /// What is recorded counts the packets from `first_packet` on.
  Walk(const LaneScene& scene, Tile& tile, LaneScratch& scratch, size_t first_packet,
       TileRecord* record, std::vector<LaneChange>* through = nullptr)
      : scene_(scene),
        tile_(tile),
        scratch_(scratch),
        leaves_(scene, tile, scratch, through),
        first_packet_(first_packet),
        record_(record),
        exact_(kExact * tile.width) {}

  /// Rays that turn different sides to the cells meet them in different order.
  void all() {
    uint32_t any_backward[3] = {}, any_forward[3] = {};
    for (size_t p = 0; p < tile_.packets; ++p)
      for (int axis = 0; axis < 3; ++axis) {
        any_backward[axis] |= tile_.meets[p] & tile_.backward[axis][p];
        any_forward[axis] |= tile_.meets[p] & ~tile_.backward[axis][p];
      }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      bool some = true;
      for (int axis = 0; axis < 3; ++axis)
        some &= (octant >> axis & 1 ? any_backward : any_forward)[axis] != 0;
      if (some) one_octant(octant);
    }
  }

 private:
  void one_octant(uint32_t octant) {
    running_count_ = 0;
    running_packets_ = 0;
    for (size_t p = 0; p < tile_.packets; ++p) {
      uint32_t lanes = tile_.meets[p];
      for (int axis = 0; axis < 3; ++axis)
        lanes &= octant >> axis & 1 ? tile_.backward[axis][p] : ~uint32_t(tile_.backward[axis][p]);
      running_[p] = uint8_t(lanes);
      running_count_ += uint32_t(std::popcount(lanes));
      if (lanes != 0) running_packets_ |= uint64_t(1) << p;
    }
    if (running_packets_ == 0) return;
    Planes region;
    for (int axis = 0; axis < 3; ++axis) {
      side_[axis] = octant >> axis & 1;
      sign_[axis] = side_[axis] ? -1 : 1;
      region.enter[axis] = (side_[axis] ? scene_.clip.hi : scene_.clip.lo)[axis];
      region.leave[axis] = (side_[axis] ? scene_.clip.lo : scene_.clip.hi)[axis];
    }
    together(region);
  }

  Bounds bounds(const Planes& region) const {
    const Real never = set(kInfinity);
    Real low_o[3], high_o[3], low_i[3], high_i[3];
    for (int axis = 0; axis < 3; ++axis)
      low_o[axis] = low_i[axis] = never, high_o[axis] = high_i[axis] = set(-kInfinity);
    Real first = never, last = set(-kInfinity);
    for (uint64_t left = running_packets_; left != 0; left &= left - 1) {
      const auto p = size_t(std::countr_zero(left));
      const Bool runs = mask_of(running_[p]);
      Real t0, t1;
      way_through(region, p, t0, t1);
      for (int axis = 0; axis < 3; ++axis) {
        const Real o = tile_.axis_origin(p, axis), i = tile_.axis_inverse(p, axis);
        low_o[axis] = hn::Min(low_o[axis], L::select(runs, o, never));
        high_o[axis] = hn::Max(high_o[axis], L::select(runs, o, set(-kInfinity)));
        low_i[axis] = hn::Min(low_i[axis], L::select(runs, i, never));
        high_i[axis] = hn::Max(high_i[axis], L::select(runs, i, set(-kInfinity)));
      }
      first = hn::Min(first, L::select(runs, t0, never));
      last = hn::Max(last, L::select(runs, t1, set(-kInfinity)));
    }
    const auto least = [](Real v) { return hn::GetLane(hn::MinOfLanes(D(), v)); };
    const auto most = [](Real v) { return hn::GetLane(hn::MaxOfLanes(D(), v)); };
    Bounds b;
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = least(low_o[axis]), ho = most(high_o[axis]);
      const double li = least(low_i[axis]), hi = most(high_i[axis]);
      b.low_origin[axis] = side_[axis] ? -ho : lo;
      b.high_origin[axis] = side_[axis] ? -lo : ho;
      b.low_inverse[axis] = side_[axis] ? -hi : li;
      b.high_inverse[axis] = side_[axis] ? -li : hi;
    }
    b.t0 = least(first), b.t1 = std::min(most(last), tile_.end);
    return b;
  }

  /// Where a packet enters and leaves the cell; not at all if t0 >= t1.
  HWY_INLINE void way_through(const Planes& cell, size_t packet, Real& t0, Real& t1) const {
    t0 = hn::Max(
        hn::Max(tile_.start(packet), tile_.passes(packet, 0, cell.enter[0])),
        hn::Max(tile_.passes(packet, 1, cell.enter[1]), tile_.passes(packet, 2, cell.enter[2])));
    t1 = hn::Min(
        hn::Min(tile_.passes(packet, 0, cell.leave[0]), tile_.passes(packet, 1, cell.leave[1])),
        tile_.passes(packet, 2, cell.leave[2]));
  }

  /// A cell, and the packets that may meet it.
  struct Place {
    Planes planes;
    double t0, t1;  ///< when the first of them enters, and the last leaves
    const Cell* cell;
    uint64_t packets;
    uint32_t rays;  ///< of those packets, that may meet it
  };

  /// All running rays. What is decided for them here holds for each: rounding is monotonic, so the
  /// bounds of the results are the results of the bounds.
  void together(const Planes& region) {
    Place later[kMostDepth];
    uint32_t waiting = 0;
    const Bounds b = bounds(region);
    Place now{region, b.t0, b.t1, scene_.tree.root, running_packets_, running_count_};
    while (true) {
      now.packets &= running_packets_;
      // The bounds meet cells that no ray does, and to refine one takes long.
      CellLink cell = now.cell->link();
      if (cell.kind() == CellKind::kOpen && is_met(now))
        cell = scratch_.refiner->refined(*now.cell);
      if (now.packets == 0 || cell.kind() == CellKind::kOpen) {
        if (waiting == 0) return;
        now = later[--waiting];
        continue;
      }
      if (cell.kind() == CellKind::kNode) {
        scratch_.stats.cells += std::min(now.rays, running_count_);
        const int axis = cell.axis();
        const double width = std::fabs(now.planes.leave[axis] - now.planes.enter[axis]);
        if (width >= exact_) {
          if (both_parts(b, cell, now, later[waiting])) ++waiting;
          continue;
        }
        if (!std::has_single_bit(now.packets)) {
          if (both_parts_of_packets(cell, now, later[waiting])) ++waiting;
          continue;
        }
        alone(size_t(std::countr_zero(now.packets)), now.cell, now.planes);
      } else {
        scratch_.stats.cells += std::min(now.rays, running_count_);
        leaf(cell, now.planes, now.packets);
      }
      if (waiting == 0 || running_packets_ == 0) return;
      now = later[--waiting];
    }
  }

  /// Goes on to the nearer part that some ray may meet. If they may meet both, the farther one is
  /// for later.
  HWY_INLINE bool both_parts(const Bounds& b, CellLink cell, Place& now, Place& far) const {
    const int axis = cell.axis();
    const double split = now.cell->split;
    const Cell* const near_cell = cell.children() + side_[axis];
    const Cell* const far_cell = cell.children() + 1 - side_[axis];
    const double low = split * sign_[axis] - b.high_origin[axis];
    const double high = split * sign_[axis] - b.low_origin[axis];
    const double first = low * (low < 0 ? b.high_inverse : b.low_inverse)[axis];
    const double last = high * (high < 0 ? b.low_inverse : b.high_inverse)[axis];
    if (!(first < now.t1)) {
      now.planes.leave[axis] = split;
      now.cell = near_cell;
      return false;
    }
    if (!(last > now.t0)) {
      now.planes.enter[axis] = split;
      now.cell = far_cell;
      return false;
    }
    fetch(*far_cell);
    far = now;
    far.cell = far_cell;
    far.planes.enter[axis] = split;
    far.t0 = std::max(far.t0, first);
    now.planes.leave[axis] = split;
    now.t1 = std::min(now.t1, last);
    now.cell = near_cell;
    return true;
  }

  /// The same, by what each packet meets.
  HWY_INLINE bool both_parts_of_packets(CellLink cell, Place& now, Place& far) const {
    const int axis = cell.axis();
    const double split = now.cell->split;
    uint64_t near_packets = 0, far_packets = 0;
    uint32_t near_rays = 0, far_rays = 0;
    for (uint64_t left = now.packets; left != 0; left &= left - 1) {
      const auto p = size_t(std::countr_zero(left));
      Real t0, t1;
      way_through(now.planes, p, t0, t1);
      const Real t = tile_.passes(p, axis, split);
      const uint32_t near_lanes = bits(t0 < hn::Min(t1, t)) & running_[p],
                     far_lanes = bits(hn::Max(t0, t) < t1) & running_[p];
      near_packets |= uint64_t(near_lanes != 0) << p, far_packets |= uint64_t(far_lanes != 0) << p;
      near_rays += uint32_t(std::popcount(near_lanes));
      far_rays += uint32_t(std::popcount(far_lanes));
    }
    const Cell* const near_cell = cell.children() + side_[axis];
    const Cell* const far_cell = cell.children() + 1 - side_[axis];
    const bool both = near_packets != 0 && far_packets != 0;
    if (both) fetch(*far_cell);
    if (far_packets != 0) {
      Place& to = both ? far : now;
      to = now;
      to.cell = far_cell;
      to.planes.enter[axis] = split;
      to.packets = far_packets, to.rays = far_rays;
      if (!both) return false;
    }
    now.cell = near_cell;
    now.planes.leave[axis] = split;
    now.packets = near_packets, now.rays = near_rays;
    return both;
  }

  /// What a cell leads to is wanted soon.
  static HWY_INLINE void fetch(const Cell& cell) {
    hwy::Prefetch(static_cast<const char*>(cell.link().target()));
  }

  /// Whether some running ray passes the cell.
  bool is_met(const Place& place) const {
    for (uint64_t left = place.packets; left != 0; left &= left - 1) {
      const auto p = size_t(std::countr_zero(left));
      Real t0, t1;
      way_through(place.planes, p, t0, t1);
      if ((bits(t0 < t1) & running_[p]) != 0) return true;
    }
    return false;
  }

  /// What a cell is, which nobody may have asked before.
  HWY_INLINE CellLink link(const Cell& cell) {
    const CellLink link = cell.link();
    return HWY_LIKELY(link.kind() != CellKind::kOpen) ? link : scratch_.refiner->refined(cell);
  }

  void leaf(CellLink cell, const Planes& planes, uint64_t packets) {
    Visitors& visitors = leaves_.visitors;
    visitors.count = 0;
    if (is_leaf(cell.kind())) {
      // It arrives while is worked out who passes.
      const char* const block = static_cast<const char*>(cell.target());
      hwy::Prefetch(block);
      hwy::Prefetch(block + 64);
    }
    const uint32_t nothing_new = cell.kind() == CellKind::kEmpty ? ~0u : 0;
    for (uint64_t left = packets; left != 0; left &= left - 1) {
      const auto p = size_t(std::countr_zero(left));
      // Who knows that it is in empty space learns nothing in an empty cell.
      if ((running_[p] & ~(nothing_new & tile_.known[p] & ~uint32_t(tile_.solid[p]))) == 0)
        continue;
      Real t0, t1;
      way_through(planes, p, t0, t1);
      visitors.add(p, bits(t0 < t1) & running_[p], t0, t1);
      if (visitors.count == kGroup) {
        pass(cell);
        visitors.count = 0;
      }
    }
    if (visitors.count != 0) pass(cell);
  }

  /// Takes the visitors through a cell that is no node.
  void pass(CellLink cell) {
    const Visitors& visitors = leaves_.visitors;
    const size_t recorded = record_ != nullptr ? record_->size() : 0;
    if (record_ != nullptr) record(cell);
    leaves_.pass(cell);
    for (size_t i = 0; i < visitors.count; ++i) stop(visitors.packet[i]);
    if (record_ != nullptr) keep_hits(recorded);
  }

  void record(CellLink cell) {
    const Visitors& visitors = leaves_.visitors;
    for (size_t i = 0; i < visitors.count; ++i) {
      const uint32_t packet = visitors.packet[i];
      LeafRecord& r = record_->emplace_back();
      r.leaf = cell;
      r.packet = uint32_t(first_packet_) + packet;
      r.lanes = visitors.lanes[i];
      r.known = tile_.known[packet], r.solid = tile_.solid[packet];
      std::copy_n(visitors.t0 + i * Tile::lanes(), Tile::lanes(), r.t0);
      std::copy_n(visitors.t1 + i * Tile::lanes(), Tile::lanes(), r.t1);
    }
  }
  void keep_hits(size_t from) {
    for (size_t i = from; i < record_->size(); ++i)
      (*record_)[i].lanes &= tile_.hit[(*record_)[i].packet - first_packet_];
    const auto is_empty = [](const LeafRecord& r) { return r.lanes == 0; };
    record_->erase(std::remove_if(record_->begin() + ptrdiff_t(from), record_->end(), is_empty),
                   record_->end());
  }

  /// Who met something runs no more.
  HWY_INLINE void stop(size_t packet) {
    const uint32_t met = running_[packet] & tile_.hit[packet];
    running_[packet] &= uint8_t(~met);
    running_count_ -= uint32_t(std::popcount(met));
    if (running_[packet] == 0) running_packets_ &= ~(uint64_t(1) << packet);
  }

  /// One packet, from a cell on. A lane takes part in a cell if its interval is not empty there, so
  /// that intervals alone say which lanes are where.
  void alone(size_t packet, const Cell* at, const Planes& planes) {
    struct Later {
      double t0[kMaxLanes], t1[kMaxLanes];
      const Cell* cell;
    };
    Later later[kMostDepth];
    uint32_t waiting = 0;
    const Real never = set(kInfinity);
    Real t0, t1;
    way_through(planes, packet, t0, t1);
    t0 = L::select(mask_of(running_[packet]), t0, never);
    if (hn::AllFalse(D(), t0 < t1)) return;
    while (true) {
      const CellLink cell = link(*at);
      const Bool active = t0 < t1;
      scratch_.stats.cells += hn::CountTrue(D(), active);
      if (cell.kind() == CellKind::kNode) {
        const Real t = tile_.passes(packet, cell.axis(), at->split);
        const Bool wants_far = hn::And(active, t < t1);
        const Bool wants_near = hn::And(active, hn::Gt(t, t0));
        const Cell* const near_cell = cell.children() + side_[cell.axis()];
        const Cell* const far_cell = cell.children() + 1 - side_[cell.axis()];
        if (hn::AllFalse(D(), wants_far)) {
          at = near_cell;
        } else if (hn::AllFalse(D(), wants_near)) {
          at = far_cell;
        } else {
          Later& far = later[waiting++];
          far.cell = far_cell;
          fetch(*far_cell);
          hn::StoreU(L::select(wants_far, hn::Max(t, t0), never), D(), far.t0);
          hn::StoreU(t1, D(), far.t1);
          at = near_cell;
          t0 = L::select(wants_near, t0, never);
          t1 = hn::Min(t, t1);
        }
        continue;
      }
      leaves_.visitors.count = 0;
      leaves_.visitors.add(packet, bits(active), t0, t1);
      pass(cell);
      // The next cell that some ray still needs.
      while (true) {
        if (waiting == 0 || running_[packet] == 0) return;
        const Later& next = later[--waiting];
        t1 = hn::LoadU(D(), next.t1);
        t0 = L::select(mask_of(running_[packet]), hn::LoadU(D(), next.t0), never);
        at = next.cell;
        if (!hn::AllFalse(D(), t0 < t1)) break;
      }
    }
  }

  const LaneScene& scene_;
  Tile& tile_;
  LaneScratch& scratch_;
  LeavesInLanes leaves_;
  size_t first_packet_;
  TileRecord* record_;  ///< or none
  double exact_;

  uint32_t side_[3] = {};  ///< the nearer child
  double sign_[3] = {};
  uint8_t running_[kMostPackets];  ///< by packet, the lanes on their way
  uint64_t running_packets_ = 0;   ///< those that have any
  uint32_t running_count_ = 0;
};

/// Calls visit(positions, places, first packet) for the tiles that some rays are cut into.
template <class Visit>
void for_tiles(std::span<const PixelPosition> positions, const uint32_t* places,
               const Visit& visit) {
  for (size_t first = 0; first < positions.size(); first += Tile::most_rays())
    visit(positions.subspan(first, std::min(Tile::most_rays(), positions.size() - first)),
          places + first, first / Tile::lanes());
}

void trace_positions(const LaneScene& scene, const Camera& camera,
                     std::span<const PixelPosition> all_positions, const uint32_t* all_places,
                     Hit* hits, LaneScratch& scratch, TileRecord* record) {
  scratch.stats.rays += all_positions.size();
  for_tiles(all_positions, all_places, [&](auto positions, auto places, size_t first_packet) {
    Tile tile;
    tile.make_rays(scene, camera, positions);
    Walk(scene, tile, scratch, first_packet, record).all();
    tile.write(scene, places, hits);
  });
}

void trace_rays(const LaneScene& scene, std::span<const Ray> all, Hit* hits, LaneScratch& scratch) {
  scratch.stats.rays += all.size();
  for (size_t first = 0; first < all.size(); first += Tile::most_rays()) {
    Tile tile;
    tile.make_rays(scene, all.subspan(first, std::min(Tile::most_rays(), all.size() - first)));
    Walk(scene, tile, scratch, 0, nullptr).all();
    tile.write(scene, kInOrder.data(), hits + first);
  }
}

void cross_rays(const LaneScene& scene, std::span<const Ray> all, RayCrossings& found,
                LaneScratch& scratch) {
  scratch.stats.rays += all.size();
  for (size_t first = 0; first < all.size(); first += Tile::most_rays()) {
    const auto rays = all.subspan(first, std::min(Tile::most_rays(), all.size() - first));
    Tile tile;
    tile.make_rays(scene, rays);
    scratch.changes.clear();
    Walk(scene, tile, scratch, 0, nullptr, &scratch.changes).all();
    // Each ray's changes are in their order already.
    std::ranges::stable_sort(scratch.changes, {}, &LaneChange::ray);
    const LaneChange* next = scratch.changes.data();
    const LaneChange* const end = next + scratch.changes.size();
    for (uint32_t i = 0; i < rays.size(); ++i) {
      const LaneChange* const begin = next;
      while (next != end && next->ray == i) ++next;
      add_crossings(scene, tile.ray(i), tile.shift(i), {begin, next}, found);
    }
  }
}

void retrace_positions(const LaneScene& scene, const Camera& camera,
                       std::span<const PixelPosition> all_positions, const uint32_t* all_places,
                       Hit* hits, LaneScratch& scratch, const TileRecord& record) {
  scratch.stats.rays += all_positions.size();
  size_t next = 0;
  for_tiles(all_positions, all_places, [&](auto positions, auto places, size_t first_packet) {
    Tile tile;
    tile.make_rays(scene, camera, positions);
    LeavesInLanes leaves(scene, tile, scratch);
    const size_t end_packet = first_packet + tile.packets;
    while (next < record.size() && record[next].packet < end_packet) {
      // As many packets at once as passed the leaf at once.
      const size_t first = next;
      leaves.visitors.count = 0;
      do {
        const LeafRecord& r = record[next];
        const size_t packet = r.packet - first_packet;
        tile.known[packet] = uint8_t(r.known), tile.solid[packet] = uint8_t(r.solid);
        leaves.visitors.add(packet, r.lanes, hn::Load(D(), r.t0), hn::Load(D(), r.t1));
        ++next;
      } while (next < record.size() && record[next].leaf.bits() == record[first].leaf.bits() &&
               record[next].packet > record[next - 1].packet && record[next].packet < end_packet &&
               leaves.visitors.count < kGroup);
      leaves.pass(record[first].leaf);
    }
    tile.write(scene, places, hits);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {

WHITTLE_EXPORT(trace_positions);
WHITTLE_EXPORT(trace_rays);
WHITTLE_EXPORT(retrace_positions);
WHITTLE_EXPORT(cross_rays);

void trace_lanes(const LaneScene& scene, const Camera& camera,
                 std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                 LaneScratch& scratch, TileRecord* record) {
  WHITTLE_DISPATCH(trace_positions)(scene, camera, positions, places, hits, scratch, record);
}

void trace_lanes(const LaneScene& scene, std::span<const Ray> rays, Hit* hits,
                 LaneScratch& scratch) {
  WHITTLE_DISPATCH(trace_rays)(scene, rays, hits, scratch);
}

void cross_lanes(const LaneScene& scene, std::span<const Ray> rays, RayCrossings& found,
                 LaneScratch& scratch) {
  WHITTLE_DISPATCH(cross_rays)(scene, rays, found, scratch);
}

void retrace_lanes(const LaneScene& scene, const Camera& camera,
                   std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                   LaneScratch& scratch, const TileRecord& record) {
  WHITTLE_DISPATCH(retrace_positions)(scene, camera, positions, places, hits, scratch, record);
}

}  // namespace whittle
#endif

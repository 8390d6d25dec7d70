#include "trace/cpu/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

// This file is compiled once for every instruction set; see foreach_target.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/cpu/lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/cpu/leaf-inl.h"
#include "trace/cpu/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

/// Where a cell's edge is shorter than this many widths of the tile, its packets go on alone.
constexpr double kAlone = 0.5;

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
  Walk(const LaneScene& scene, Tile& tile, LaneScratch& scratch, TileRecord* record)
      : scene_(scene),
        tile_(tile),
        scratch_(scratch),
        leaves_(scene, tile, scratch),
        record_(record),
        alone_(kAlone * tile.width) {}

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
    b.t0 = least(first), b.t1 = most(last);
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

  /// All running rays. What is decided for them here holds for each: rounding is monotonic, so the
  /// bounds of the results are the results of the bounds.
  void together(const Planes& region) {
    struct Later {
      Planes planes;
      double t0, t1;
      const Cell* cell;
    };
    Later later[kMostDepth];
    uint32_t waiting = 0;
    const Bounds b = bounds(region);
    Later now{region, b.t0, b.t1, scene_.tree.root};
    while (true) {
      const CellLink cell = link(*now.cell);
      scratch_.stats.cells += running_count_;
      if (cell.kind() == CellKind::kNode) {
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
          continue;
        }
        if (!(last > now.t0)) {
          now.planes.enter[axis] = split;
          now.cell = far_cell;
          continue;
        }
        if (std::fabs(now.planes.leave[axis] - now.planes.enter[axis]) >= alone_) {
          Later& far = later[waiting++];
          far = now;
          far.cell = far_cell;
          far.planes.enter[axis] = split;
          far.t0 = std::max(far.t0, first);
          now.planes.leave[axis] = split;
          now.t1 = std::min(now.t1, last);
          now.cell = near_cell;
          continue;
        }
        for (uint64_t left = running_packets_; left != 0; left &= left - 1)
          alone(size_t(std::countr_zero(left)), now.cell, now.planes);
      } else {
        leaf(cell, now.planes);
      }
      if (waiting == 0 || running_packets_ == 0) return;
      now = later[--waiting];
    }
  }

  /// What a cell is, which nobody may have asked before.
  HWY_INLINE CellLink link(const Cell& cell) {
    const CellLink link = cell.link();
    return HWY_LIKELY(link.kind() != CellKind::kOpen) ? link : scratch_.refiner->refined(cell);
  }

  void leaf(CellLink cell, const Planes& planes) {
    Visitors& visitors = leaves_.visitors;
    visitors.count = 0;
    const uint32_t nothing_new = cell.kind() == CellKind::kEmpty ? ~0u : 0;
    for (uint64_t left = running_packets_; left != 0; left &= left - 1) {
      const auto p = size_t(std::countr_zero(left));
      // Who knows that it is in empty space learns nothing in an empty cell.
      if ((running_[p] & ~(nothing_new & tile_.known[p] & ~uint32_t(tile_.solid[p]))) == 0)
        continue;
      Real t0, t1;
      way_through(planes, p, t0, t1);
      visitors.add(p, bits(t0 < t1) & running_[p], t0, t1);
    }
    pass(cell);
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
      r.packet = packet;
      r.lanes = visitors.lanes[i];
      r.known = tile_.known[packet], r.solid = tile_.solid[packet];
      std::copy_n(visitors.t0 + i * Tile::lanes(), Tile::lanes(), r.t0);
      std::copy_n(visitors.t1 + i * Tile::lanes(), Tile::lanes(), r.t1);
    }
  }
  void keep_hits(size_t from) {
    for (size_t i = from; i < record_->size(); ++i)
      (*record_)[i].lanes &= tile_.hit[(*record_)[i].packet];
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
  TileRecord* record_;  ///< or none
  double alone_;

  uint32_t side_[3] = {};  ///< the nearer child
  double sign_[3] = {};
  uint8_t running_[kMostPackets];  ///< by packet, the lanes on their way
  uint64_t running_packets_ = 0;   ///< those that have any
  uint32_t running_count_ = 0;
};

void trace_positions(const LaneScene& scene, const Camera& camera,
                     std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                     LaneScratch& scratch, TileRecord* record) {
  Tile tile;
  scratch.stats.rays += positions.size();
  tile.make_rays(scene, camera, positions);
  Walk(scene, tile, scratch, record).all();
  tile.write(scene, places, hits);
}

void retrace_positions(const LaneScene& scene, const Camera& camera,
                       std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                       LaneScratch& scratch, const TileRecord& record) {
  Tile tile;
  scratch.stats.rays += positions.size();
  tile.make_rays(scene, camera, positions);
  LeavesInLanes leaves(scene, tile, scratch);
  for (size_t i = 0; i < record.size();) {
    // As many packets at once as passed the leaf at once.
    const size_t first = i;
    leaves.visitors.count = 0;
    do {
      const LeafRecord& r = record[i];
      tile.known[r.packet] = uint8_t(r.known), tile.solid[r.packet] = uint8_t(r.solid);
      leaves.visitors.add(r.packet, r.lanes, hn::Load(D(), r.t0), hn::Load(D(), r.t1));
      ++i;
    } while (i < record.size() && record[i].leaf.bits() == record[first].leaf.bits() &&
             record[i].packet > record[i - 1].packet);
    leaves.pass(record[first].leaf);
  }
  tile.write(scene, places, hits);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whittle {

HWY_EXPORT(trace_positions);
HWY_EXPORT(retrace_positions);

void trace_lanes(const LaneScene& scene, const Camera& camera,
                 std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                 LaneScratch& scratch, TileRecord* record) {
  HWY_DYNAMIC_DISPATCH(trace_positions)(scene, camera, positions, places, hits, scratch, record);
}

void retrace_lanes(const LaneScene& scene, const Camera& camera,
                   std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                   LaneScratch& scratch, const TileRecord& record) {
  HWY_DYNAMIC_DISPATCH(retrace_positions)(scene, camera, positions, places, hits, scratch, record);
}

}  // namespace whittle
#endif

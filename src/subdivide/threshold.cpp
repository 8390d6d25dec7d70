#include "subdivide/threshold.h"

#include <array>
#include <utility>

#include "base/result.h"
#include "subdivide/refine.h"

namespace whittle {
namespace {

/// As many subtrees as this keep all threads busy.
constexpr size_t kEnough = 256;

/// Of all cells at least one in so many is in use; small trees do not mind.
constexpr uint64_t kMostPerUsed = 4, kFewCells = 4096;

struct Place {
  const Cell* cell;
  Box box;
  size_t depth = 0;  ///< below where a mover began
};

/// Moves cells from one side of a threshold to the other; for one thread.
class Mover {
 public:
  /// `number`: of the move.
  Mover(const IsSmall& is_small, Vec3 origin, uint64_t number)
      : is_small_(is_small), origin_(origin), number_(number) {}

  /// Moves the cell, and adds what lies below it then.
  void move(const Place& at, std::vector<Place>& below) {
    ++moved_.cells;
    pairs_.resize(at.depth);
    if (at.depth > 0) pairs_.back() = &pair_of(*at.cell);
    uint64_t& there = across(*at.cell);
    CellLink link = at.cell->link();
    if (there != kNowhere) {
      const bool small = is_small_({at.box.lo + origin_, at.box.hi + origin_});
      if (small == bool(there & CellLink::kIfSmall)) {
        const CellLink other(there & ~CellLink::kIfSmall);
        there = link.bits() | (small ? 0 : CellLink::kIfSmall);
        at.cell->bits.store(other.bits(), std::memory_order_release);
        --kinds_[size_t(link.kind())];
        ++kinds_[size_t(other.kind())];
        ++(small ? moved_.closed : moved_.opened);
        link = other;
        note_change();
      }
    }
    if (link.kind() != CellKind::kNode) return;
    Place low{link.children(), at.box, at.depth + 1},
        high{link.children() + 1, at.box, at.depth + 1};
    low.box.hi[link.axis()] = high.box.lo[link.axis()] = at.cell->split;
    below.push_back(high);
    below.push_back(low);
  }
  /// Moves the cell and all below it.
  void move_all(const Cell& cell, const Box& box) {
    places_.assign(1, {&cell, box});
    while (!places_.empty()) {
      const Place next = places_.back();
      places_.pop_back();
      move(next, places_);
    }
  }

  const MovedThreshold& moved() const { return moved_; }
  /// How many cells of each kind there are more than before; wraps.
  const std::array<uint64_t, kCellKinds>& kinds() const { return kinds_; }

 private:
  void note_change() {
    for (size_t i = pairs_.size(); i-- > 0 && pairs_[i]->changed != number_;)
      pairs_[i]->changed = number_;
  }

  const IsSmall& is_small_;
  Vec3 origin_;
  uint64_t number_;
  std::vector<Place> places_;
  std::vector<CellPair*> pairs_;  ///< on the way down to the cell
  MovedThreshold moved_;
  std::array<uint64_t, kCellKinds> kinds_{};
};

}  // namespace

MovedThreshold RefinerPool::move(IsSmall is_small, const Workers& workers) {
  WHITTLE_CHECK(settings_.is_small && is_small);
  settings_.is_small = std::move(is_small);
  ++moves_;
  PerWorker<Mover> movers(workers);
  std::vector<Place> level{{&root(), scene_.region}}, below;
  while (!level.empty() && level.size() < kEnough) {
    below.clear();
    Mover& mover = movers.of(0, settings_.is_small, scene_.origin, moves_);
    for (const Place& at : level) mover.move({at.cell, at.box}, below);
    std::swap(level, below);
    // Several movers may change what is below: it counts as changed.
    for (const Place& at : level) pair_of(*at.cell).changed = moves_;
  }
  workers.for_parts(level.size(), 1, [&](size_t first, size_t last, size_t worker) {
    Mover& mover = movers.of(worker, settings_.is_small, scene_.origin, moves_);
    for (size_t i = first; i < last; ++i) mover.move_all(*level[i].cell, level[i].box);
  });
  MovedThreshold sum;
  Refiner& refiner = take();
  movers.for_each([&](const Mover& mover) {
    sum.cells += mover.moved().cells;
    sum.opened += mover.moved().opened;
    sum.closed += mover.moved().closed;
    for (size_t kind = 0; kind < kCellKinds; ++kind)
      refiner.store_.stats.cells[kind] += mover.kinds()[kind];
  });
  give(refiner);
  const SubdivideStats all = stats();
  sum.is_crowded = all.memory_bytes > settings_.memory ||
                   all.cell_count() > kFewCells + kMostPerUsed * sum.cells;
  return sum;
}

MovedThreshold move_threshold(const CellTree& tree, IsSmall is_small, const Workers& workers) {
  return tree.refiner_pool->move(std::move(is_small), workers);
}

}  // namespace whittle

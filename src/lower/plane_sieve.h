// Separates planes that stand alone from those that have others near them. In most models nearly
// all stand alone: of a million facets of a mesh hardly one comes near another.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "lower/cell_hash.h"

namespace whittle {

/// Where a plane {p : n.p = offset} is; n is a unit vector. Either side may be meant.
struct PlanePlace {
  Vec3 n;
  double offset;
};

/// A hash table of cells in the space of normals and offsets. A cell holds its planes until someone
/// asks for what is near and gets them; from then on it holds none.
class PlaneSieve {
 public:
  /// Planes are near each other that differ by no more than this in their offsets, and in each
  /// coordinate of their normals, once both are turned the same way.
  PlaneSieve(double offset_slack, double normal_slack)
      : offset_slack_(offset_slack), normal_slack_(normal_slack), slots_(kFewSlots) {}

  double offset_slack() const { return offset_slack_; }
  double normal_slack() const { return normal_slack_; }

  /// Takes what the cells hold in which planes near this one are: calls visit(number) for each.
  /// Whether any plane is or was in these cells.
  template <class Visit>
  bool take_near(const PlanePlace& plane, const Visit& visit) {
    const double side = turned(plane.n);
    bool any = take_cells(plane, side < 0, visit);
    // Those near it may be turned the other way.
    if (std::fabs(side) <= 2 * normal_slack_) any |= take_cells(plane, !(side < 0), visit);
    return any;
  }

  /// Adds a plane; numbers rise. False if its cell does not hold it, as others in it have been
  /// taken.
  bool add(const PlanePlace& plane, uint32_t number) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    next_.resize(number + 1, kNone);
    const bool flip = turned(plane.n) < 0;
    Cell cell;
    for (size_t i = 0; i < 4; ++i) cell[i] = cell_coordinate(coordinate(plane, flip, i));
    const uint64_t hash = hash_of(cell);
    Slot& slot = slots_[find(hash)];
    if (slot.last == kTaken) return false;
    if (slot.last == kNone) ++count_;
    next_[number] = slot.last;
    slot = {tag_of(hash), number};
    return true;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX, kTaken = UINT32_MAX - 1;
  static constexpr size_t kFewSlots = 64;  ///< to begin with; a power of two
  /// A cell's width in slacks: most of what is looked for is in one cell.
  static constexpr double kWidth = 16;
  using Cell = CellPlace<4>;
  /// Different cells with equal tags are one cell here: then more seems to be near than is.
  struct Slot {
    uint32_t tag = 0;
    uint32_t last = kNone;  ///< the plane in it that came last; the others are linked to it
  };

  /// Positive if the plane is turned as it is kept. The direction is one that no model favours.
  static double turned(Vec3 n) { return dot(n, Vec3{0.8117, 0.4733, 0.3421}); }

  double coordinate(const PlanePlace& plane, bool flip, size_t i) const {
    const double x = i < 3 ? plane.n[int(i)] / (kWidth * normal_slack_)
                           : plane.offset / (kWidth * offset_slack_);
    return flip ? -x : x;
  }

  template <class Visit>
  bool take_cells(const PlanePlace& plane, bool flip, const Visit& visit) {
    Cell from, to;
    for (size_t i = 0; i < 4; ++i) {
      const double x = coordinate(plane, flip, i);
      from[i] = cell_coordinate(x - 1 / kWidth);
      to[i] = cell_coordinate(x + 1 / kWidth);
    }
    bool any = false;
    Cell cell;
    for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
      for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
        for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
          for (cell[3] = from[3]; cell[3] <= to[3]; ++cell[3]) {
            Slot& slot = slots_[find(hash_of(cell))];
            if (slot.last == kNone) continue;
            any = true;
            if (slot.last == kTaken) continue;
            for (uint32_t i = slot.last; i != kNone; i = next_[i]) visit(i);
            slot.last = kTaken;
          }
    return any;
  }

  /// Slots go by a hash of the tag, so that a table can grow without the planes.
  static uint32_t tag_of(uint64_t hash) { return uint32_t(hash); }
  size_t first_slot(uint32_t tag) const {
    return size_t(tag * 0x9e3779b97f4a7c15ull >> 32) & (slots_.size() - 1);
  }
  size_t find(uint64_t hash) const {
    const uint32_t tag = tag_of(hash);
    size_t i = first_slot(tag);
    while (slots_[i].last != kNone && slots_[i].tag != tag) i = (i + 1) & (slots_.size() - 1);
    return i;
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.last == kNone) continue;
      size_t i = first_slot(slot.tag);
      while (slots_[i].last != kNone) i = (i + 1) & (slots_.size() - 1);
      slots_[i] = slot;
    }
  }

  double offset_slack_, normal_slack_;
  std::vector<Slot> slots_;
  std::vector<uint32_t> next_;  ///< by number: another plane in its cell
  size_t count_ = 0;            ///< slots in use
};

}  // namespace whittle

// Points in space, found by box: what stands near one another is found without looking at the rest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lower/cell_hash.h"

namespace whittle {

/// A hash table of unit cells. Points should be scaled such that boxes asked for are not much
/// larger than 1.
class PointIndex {
 public:
  using Point = std::array<double, 3>;

  void add(const Point& point, uint32_t number) {
    places_.push_back({point, kNone, number});
    if (places_.size() > head_.size())
      grow();
    else
      link(uint32_t(places_.size() - 1));
  }

  /// Calls visit(number) for all with low <= point <= high in every coordinate, in any order, and
  /// perhaps more than once, until it returns false.
  template <class Visit>
  void visit(const Point& low, const Point& high, const Visit& visit) const {
    const auto look = [&](const Place& place) {
      for (int i = 0; i < 3; ++i)
        if (!(low[i] <= place.point[i] && place.point[i] <= high[i])) return true;
      return visit(place.number);
    };
    const Cell from = cell_of(low), to = cell_of(high);
    double cells = 1;
    for (int i = 0; i < 3; ++i) cells *= double(to[i] - from[i]) + 1;
    if (!(cells <= double(places_.size()))) {
      for (const Place& place : places_)
        if (!look(place)) return;
      return;
    }
    Cell cell;
    for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
      for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
        for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
          for (uint32_t i = head_[slot_of(cell)]; i != kNone; i = places_[i].next)
            if (!look(places_[i])) return;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  static constexpr size_t kFewSlots = 64;  ///< to begin with; a power of two
  using Cell = CellPlace<3>;
  struct Place {
    Point point;
    uint32_t next;  ///< in the chain of the cells that have this slot
    uint32_t number;
  };

  static Cell cell_of(const Point& p) {
    Cell cell;
    for (size_t i = 0; i < 3; ++i) cell[i] = cell_coordinate(p[i]);
    return cell;
  }
  size_t slot_of(const Cell& cell) const { return hash_of(cell) & (head_.size() - 1); }

  void link(uint32_t place) {
    uint32_t& head = head_[slot_of(cell_of(places_[place].point))];
    places_[place].next = head;
    head = place;
  }
  void grow() {
    head_.assign(2 * head_.size(), kNone);
    for (uint32_t i = 0; i < places_.size(); ++i) link(i);
  }

  std::vector<Place> places_;
  std::vector<uint32_t> head_ = std::vector<uint32_t>(kFewSlots, kNone);
};

}  // namespace whittle

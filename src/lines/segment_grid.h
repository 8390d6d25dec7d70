// Which of many straight lines of the plane come near another one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace whittle {

struct Segment {
  Vec2 a, b;
};

class SegmentGrid {
 public:
  /// Memory follows the number of segments, however long they are.
  explicit SegmentGrid(std::span<const Segment> segments);

  /// Which segments were visited for the one that is asked about. Each thread needs its own.
  class Visited {
   public:
    /// `segments`: as many as the grid has.
    explicit Visited(size_t segments) : turns_(segments, 0) {}

   private:
    friend class SegmentGrid;
    void begin() {
      if (++turn_ == 0) {
        std::fill(turns_.begin(), turns_.end(), 0);
        turn_ = 1;
      }
    }
    bool add(uint32_t segment) { return std::exchange(turns_[segment], turn_) != turn_; }

    std::vector<uint32_t> turns_;
    uint32_t turn_ = 0;
  };

  /// Calls `visit(number)` once for each segment that comes nearer than a cell's ten-thousandth to
  /// the given one, and for others. Returns how many it found in the cells, those counted several
  /// times that share several: the time follows that.
  template <class Visit>
  size_t for_near(const Segment& segment, Visited& visited, const Visit& visit) const {
    visited.begin();
    size_t found = 0;
    for_cells(segment, [&](size_t cell) {
      found += firsts_[cell + 1] - firsts_[cell];
      for (uint32_t i = firsts_[cell]; i < firsts_[cell + 1]; ++i)
        if (visited.add(members_[i])) visit(members_[i]);
    });
    return found;
  }

 private:
  void choose_cells(double per_cell, double width, double height);
  template <class Visit>
  void for_cells(const Segment& segment, const Visit& visit) const;
  int column(double x) const { return cell(x - lo_.x, columns_); }
  int row(double y) const { return cell(y - lo_.y, rows_); }
  int cell(double at, int count) const {
    const double c = std::floor(at / edge_);
    return c > 0 ? c < count ? int(c) : count - 1 : 0;
  }

  Vec2 lo_;
  double edge_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<uint32_t> firsts_, members_;  ///< by cell
};

/// In every row, the columns that the segment runs through, and a little to all sides.
template <class Visit>
void SegmentGrid::for_cells(const Segment& segment, const Visit& visit) const {
  const double margin = edge_ * 1e-4;
  const Vec2 low = segment.a.y <= segment.b.y ? segment.a : segment.b,
             high = segment.a.y <= segment.b.y ? segment.b : segment.a;
  const int last_row = row(high.y + margin);
  const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
  for (int r = row(low.y - margin); r <= last_row; ++r) {
    // The outermost rows hold what is beyond them, too.
    const double bottom = r == 0 ? low.y : std::max(low.y, lo_.y + r * edge_ - margin);
    const double top = r == rows_ - 1 ? high.y : std::min(high.y, lo_.y + (r + 1) * edge_ + margin);
    double x0 = low.x, x1 = high.x;
    if (slope != 0) {
      x0 = low.x + (std::min(bottom, high.y) - low.y) * slope;
      x1 = low.x + (std::max(top, low.y) - low.y) * slope;
    }
    if (x0 > x1) std::swap(x0, x1);
    const int last_column = column(x1 + margin);
    for (int c = column(x0 - margin); c <= last_column; ++c)
      visit(size_t(r) * size_t(columns_) + size_t(c));
  }
}

}  // namespace whittle

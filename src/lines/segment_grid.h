// Which of many straight lines of the plane come near another one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
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

  /// Calls `visit(number)` for all segments that come nearer than a cell's ten-thousandth to the
  /// given one, and for others. Some are named several times.
  template <class Visit>
  void for_near(const Segment& segment, const Visit& visit) const {
    for_cells(segment, [&](size_t cell) {
      for (uint32_t i = firsts_[cell]; i < firsts_[cell + 1]; ++i) visit(members_[i]);
    });
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

#include "lines/segment_grid.h"

#include <limits>

namespace whittle {

SegmentGrid::SegmentGrid(std::span<const Segment> segments) {
  Vec2 lo{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}, hi = -lo;
  for (const Segment& s : segments) {
    for (const Vec2 p : {s.a, s.b}) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
  }
  if (segments.empty()) lo = hi = {};
  lo_ = lo;
  const size_t most = 16 * segments.size() + 1024;
  for (double per_cell = 1;; per_cell *= 4) {
    choose_cells(double(segments.size()) / per_cell, hi.x - lo.x, hi.y - lo.y);
    firsts_.assign(size_t(columns_) * size_t(rows_) + 1, 0);
    size_t count = 0;
    for (const Segment& s : segments) {
      for_cells(s, [&](size_t cell) { ++firsts_[cell + 1], ++count; });
      if (count > most) break;
    }
    if (count <= most || firsts_.size() == 2) break;
  }
  for (size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
  members_.resize(firsts_.back());
  std::vector<uint32_t> next(firsts_.begin(), firsts_.end() - 1);
  for (uint32_t i = 0; i < segments.size(); ++i)
    for_cells(segments[i], [&](size_t cell) { members_[next[cell]++] = i; });
}

/// About `cells` squares.
void SegmentGrid::choose_cells(double cells, double width, double height) {
  constexpr double kMost = 2048;  // in a row
  const double longest = std::max(width, height);
  edge_ = std::max(std::sqrt(width * height / std::max(cells, 1.0)), longest / kMost);
  if (!(cells > 1)) edge_ = longest * 2;
  if (!(edge_ > 0)) edge_ = 1;
  columns_ = int(width / edge_) + 1;
  rows_ = int(height / edge_) + 1;
}

}  // namespace whittle

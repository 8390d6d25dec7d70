#include "lines/single_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lines/gather_parts.h"

namespace whittle {
namespace {

using Interval = std::pair<double, double>;

/// Where a line is covered by another one that lies on it; empty if nowhere.
Interval covered(const Segment& line, const Segment& by, double apart) {
  constexpr Interval kNowhere{0, 0};
  const Vec2 along = line.b - line.a;
  const double square = dot(along, along);
  double s0 = dot(by.a - line.a, along) / square, s1 = dot(by.b - line.a, along) / square;
  double d0 = cross(along, by.a - line.a), d1 = cross(along, by.b - line.a);
  if (s0 > s1) std::swap(s0, s1), std::swap(d0, d1);
  const double from = std::max(s0, 0.0), to = std::min(s1, 1.0);
  if (!(from < to)) return kNowhere;
  const double most = apart * std::sqrt(square);
  const auto away = [&](double s) { return std::fabs(d0 + (d1 - d0) * (s - s0) / (s1 - s0)); };
  if (away(from) > most || away(to) > most) return kNowhere;
  return {from, to};
}

/// Adds what the intervals leave of 0..1.
void add_rest(const KindLine& line, std::vector<Interval>& gone, double shortest,
              std::vector<KindLine>& out) {
  std::sort(gone.begin(), gone.end());
  const Vec2 along = line.segment.b - line.segment.a;
  const double size = length(along);
  double from = 0;
  const auto add = [&](double to) {
    if ((to - from) * size > shortest)
      out.push_back({{from == 0 ? line.segment.a : line.segment.a + along * from,
                      to == 1 ? line.segment.b : line.segment.a + along * to},
                     line.kind});
  };
  for (const Interval& interval : gone) {
    if (interval.first > from) add(interval.first);
    from = std::max(from, interval.second);
  }
  add(1);
}

}  // namespace

Result<std::vector<KindLine>> single_lines(std::span<const KindLine> lines, double apart,
                                           double shortest, const Workers& workers,
                                           const LineLimits& limits) {
  std::vector<Segment> segments;
  segments.reserve(lines.size());
  for (const KindLine& line : lines) segments.push_back(line.segment);
  const SegmentGrid grid(segments);
  LineBudget budget(limits);
  return gather_parts<KindLine>(
      lines.size(), segments.size(), workers, budget,
      [&](size_t i, SegmentGrid::Visited& visited, std::vector<KindLine>& out) {
        const size_t before = out.size();
        std::vector<Interval> gone;
        const size_t pairs = grid.for_near(segments[i], visited, [&](uint32_t other) {
          if (other >= i) return;
          const Interval interval = covered(segments[i], segments[other], apart);
          if (interval.first < interval.second) gone.push_back(interval);
        });
        add_rest(lines[i], gone, shortest, out);
        budget.add(pairs, out.size() - before);
      });
}

}  // namespace whittle

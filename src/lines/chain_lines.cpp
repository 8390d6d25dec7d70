#include "lines/chain_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace whittle {
namespace {

struct GridPoint {
  int64_t x = 0, y = 0;
  auto operator<=>(const GridPoint&) const = default;
};

GridPoint rounded(Vec2 p, double step) {
  return {std::llround(p.x / step), std::llround(p.y / step)};
}

/// The lines of one kind by their ends. An end is its line's number * 2, plus 1 at b.
class Ends {
 public:
  explicit Ends(std::vector<std::pair<GridPoint, GridPoint>> lines) : lines_(std::move(lines)) {
    sorted_.reserve(2 * lines_.size());
    for (uint32_t i = 0; i < lines_.size(); ++i)
      sorted_.push_back({lines_[i].first, 2 * i}), sorted_.push_back({lines_[i].second, 2 * i + 1});
    std::sort(sorted_.begin(), sorted_.end());
    partner_.resize(2 * lines_.size(), kNone);
    for (size_t i = 0; i < sorted_.size();) {
      size_t end = i + 1;
      while (end < sorted_.size() && sorted_[end].first == sorted_[i].first) ++end;
      if (end == i + 2) {
        partner_[sorted_[i].second] = sorted_[i + 1].second;
        partner_[sorted_[i + 1].second] = sorted_[i].second;
      }
      i = end;
    }
  }

  static constexpr uint32_t kNone = UINT32_MAX;
  size_t size() const { return lines_.size(); }
  GridPoint point(uint32_t end) const {
    return end & 1 ? lines_[end >> 1].second : lines_[end >> 1].first;
  }
  /// The one end of another line, or of the same, at its place.
  uint32_t partner(uint32_t end) const { return partner_[end]; }

 private:
  std::vector<std::pair<GridPoint, GridPoint>> lines_;
  std::vector<std::pair<GridPoint, uint32_t>> sorted_;
  std::vector<uint32_t> partner_;
};

/// Whether all points between two are nearer to their line than a step, and between its ends.
bool is_straight(std::span<const GridPoint> points) {
  const GridPoint a = points.front(), b = points.back();
  const double x = double(b.x - a.x), y = double(b.y - a.y), size = std::hypot(x, y);
  for (const GridPoint& p : points.subspan(1, points.size() - 2)) {
    const double px = double(p.x - a.x), py = double(p.y - a.y);
    const double along = px * x + py * y;
    if (std::fabs(px * y - py * x) > size || along < 0 || along > size * size) return false;
  }
  return true;
}

/// Leaves out what lies on the line between its neighbours; so many at most in a row.
void simplify(std::vector<GridPoint>& points) {
  constexpr size_t kMostInRow = 64;
  std::vector<GridPoint> kept{points.front()};
  size_t from = 0;
  while (from + 1 < points.size()) {
    size_t to = from + 1;
    while (to + 1 < points.size() && to - from < kMostInRow &&
           is_straight(std::span(points).subspan(from, to + 2 - from)))
      ++to;
    kept.push_back(points[to]);
    from = to;
  }
  points = std::move(kept);
}

class Chainer {
 public:
  Chainer(const Ends& ends, LineKind kind, double step)
      : ends_(ends), kind_(kind), step_(step), used_(ends.size(), false) {}

  void run(std::vector<DrawnPath>& out) {
    for (uint32_t end = 0; end < 2 * ends_.size(); ++end)
      if (ends_.partner(end) == Ends::kNone) add(end, out);
    // What is left are rings.
    for (uint32_t line = 0; line < ends_.size(); ++line) add(2 * line, out);
  }

 private:
  void add(uint32_t end, std::vector<DrawnPath>& out) {
    if (used_[end >> 1]) return;
    std::vector<GridPoint> points{ends_.point(end)};
    for (uint32_t at = end; at != Ends::kNone && !used_[at >> 1]; at = ends_.partner(at ^ 1)) {
      used_[at >> 1] = true;
      points.push_back(ends_.point(at ^ 1));
    }
    simplify(points);
    DrawnPath path{.kind = kind_,
                   .is_closed = points.size() > 3 && points.front() == points.back(),
                   .points = {}};
    if (path.is_closed) points.pop_back();
    for (const GridPoint& p : points)
      path.points.push_back({double(p.x) * step_, double(p.y) * step_});
    out.push_back(std::move(path));
  }

  const Ends& ends_;
  LineKind kind_;
  double step_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<DrawnPath> chain_lines(std::span<const KindLine> lines, double step) {
  std::vector<DrawnPath> paths;
  for (const LineKind kind : {LineKind::kSilhouette, LineKind::kEdge, LineKind::kHidden}) {
    std::vector<std::pair<GridPoint, GridPoint>> rounds;
    for (const KindLine& line : lines) {
      if (line.kind != kind) continue;
      const GridPoint a = rounded(line.segment.a, step), b = rounded(line.segment.b, step);
      if (a != b) rounds.push_back({a, b});
    }
    const Ends ends(std::move(rounds));
    Chainer(ends, kind, step).run(paths);
  }
  return paths;
}

}  // namespace whittle

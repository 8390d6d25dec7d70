#include "lines/split_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lines/gather_parts.h"
#include "lines/segment_grid.h"

namespace whittle {
namespace {

/// The places at which one line is cut by others.
class Cutter {
 public:
  Cutter(const DrawnLine& line, const ViewProjection& projection, double slack)
      : line_(line), projection_(projection), along_(line.b - line.a), slack_(slack) {
    length_ = whittle::length(along_);
  }

  double length() const { return length_; }

  void cut(const DrawnLine& by, std::vector<double>& places) const {
    const Vec2 other = by.b - by.a, between = by.a - line_.a;
    const double slack = slack_ / length_;
    // Its ends, where they lie on the line: two that go on from one another must not be missed.
    for (const auto& [end, key] : {std::pair(by.a, by.key_a), std::pair(by.b, by.key_b)}) {
      const Vec2 way = end - line_.a;
      if (std::fabs(cross(along_, way)) > slack_ * length_) continue;
      add(dot(way, along_) / (length_ * length_), key, places);
    }
    const double turn = cross(along_, other);
    if (turn == 0) return;
    const double s = cross(between, other) / turn, t = cross(between, along_) / turn;
    if (s > slack && s < 1 - slack && t >= 0 && t <= 1) add(s, by.key(t), places);
  }

 private:
  void add(double s, double key, std::vector<double>& places) const {
    // A line behind this one hides nothing of it.
    if (s > 0 && s < 1 && !projection_.is_before(line_.key(s), key)) places.push_back(s);
  }

  const DrawnLine& line_;
  const ViewProjection& projection_;
  Vec2 along_;
  double slack_, length_ = 0;
};

/// Sorts the places, and leaves out those that would make a part too short.
void keep_apart(std::vector<double>& places, double shortest) {
  std::sort(places.begin(), places.end());
  size_t kept = 0;
  double from = 0;
  for (const double place : places) {
    if (place - from < shortest || 1 - place < shortest) continue;
    places[kept++] = from = place;
  }
  places.resize(kept);
}

/// Adds the parts between the places.
void add_parts(uint32_t line, const std::vector<double>& places, std::vector<LinePart>& out) {
  double from = 0;
  for (const double place : places) out.push_back({line, std::exchange(from, place), place});
  out.push_back({line, from, 1});
}

double reach(std::span<const DrawnLine> lines) {
  double most = 0;
  for (const DrawnLine& line : lines)
    for (const Vec2 p : {line.a, line.b}) most = std::max({most, std::fabs(p.x), std::fabs(p.y)});
  return most;
}

}  // namespace

Result<std::vector<LinePart>> split_lines(std::span<const DrawnLine> lines,
                                          std::span<const DrawnLine> covering,
                                          const ViewProjection& projection, double length,
                                          const Workers& workers, const LineLimits& limits) {
  std::vector<Segment> segments;
  segments.reserve(covering.size());
  for (const DrawnLine& line : covering) segments.push_back({line.a, line.b});
  const SegmentGrid grid(segments);
  const double slack = 1e-12 * (reach(lines) + reach(covering));
  LineBudget budget(limits);
  return gather_parts<LinePart>(
      lines.size(), segments.size(), workers, budget,
      [&](size_t i, SegmentGrid::Visited& visited, std::vector<LinePart>& out) {
        const Cutter cutter(lines[i], projection, slack);
        std::vector<double> places;
        size_t pairs = 0;
        if (cutter.length() > length)
          pairs = grid.for_near({lines[i].a, lines[i].b}, visited,
                                [&](uint32_t number) { cutter.cut(covering[number], places); });
        keep_apart(places, length / cutter.length());
        // Before memory is taken for them.
        budget.add(pairs, places.size() + 1);
        if (!budget.is_spent()) add_parts(uint32_t(i), places, out);
      });
}

}  // namespace whittle

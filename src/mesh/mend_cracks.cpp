#include "mesh/mend_cracks.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "mesh/weld_points.h"

namespace whittle {
namespace {

struct OpenEdge {
  uint32_t a, b;
  std::vector<uint32_t> triangles;
};

std::vector<OpenEdge> open_edges(const std::vector<Corners>& triangles, size_t point_count) {
  std::vector<OpenEdge> edges;
  for_each_edge(triangles, point_count, [&](uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
    if (uses.size() % 2 == 0) return;
    OpenEdge& edge = edges.emplace_back(OpenEdge{a, b, {}});
    for (const EdgeUse& use : uses) edge.triangles.push_back(use.triangle);
  });
  return edges;
}

/// The corners of open edges, each once.
std::vector<uint32_t> corners_of(const std::vector<OpenEdge>& edges) {
  std::vector<uint32_t> corners;
  for (const OpenEdge& edge : edges) corners.insert(corners.end(), {edge.a, edge.b});
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Makes corners that are near to one another one. False if there are none.
bool weld_corners(std::span<const Vec3> points, const std::vector<uint32_t>& corners, double reach,
                  std::vector<Corners>& triangles) {
  std::vector<Vec3> places;
  for (const uint32_t corner : corners) places.push_back(points[corner]);
  const std::vector<uint32_t> first = weld_points(places, reach);
  std::vector<uint32_t> now(points.size());
  for (uint32_t i = 0; i < now.size(); ++i) now[i] = i;
  bool any = false;
  for (size_t i = 0; i < corners.size(); ++i) {
    any |= first[i] != i;
    now[corners[i]] = corners[first[i]];
  }
  if (!any) return false;
  std::erase_if(triangles, [&](Corners& t) {
    for (uint32_t& corner : t) corner = now[corner];
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return true;
}

/// Points to be found by the segments they lie on: halved again and again, along x, y and z in turn
/// (Bentley's k-d tree).
class PointTree {
 public:
  PointTree(std::span<const Vec3> points, std::vector<uint32_t> numbers)
      : points_(points), numbers_(std::move(numbers)) {
    std::vector<Range> open{{0, numbers_.size(), 0}};
    while (!open.empty()) {
      const auto [from, to, axis] = open.back();
      open.pop_back();
      if (to - from < 2) continue;
      const size_t middle = from + (to - from) / 2;
      const auto at = [&](size_t i) { return numbers_.begin() + std::ptrdiff_t(i); };
      std::nth_element(at(from), at(middle), at(to), [&, axis = axis](uint32_t x, uint32_t y) {
        return std::pair(points_[x][axis], x) < std::pair(points_[y][axis], y);
      });
      open.push_back({from, middle, (axis + 1) % 3});
      open.push_back({middle + 1, to, (axis + 1) % 3});
    }
  }

  /// Calls visit(number, t) for the points that may be within `reach` of the segment from a to b,
  /// t being where along it. Takes from `budget`, and stops where that is spent.
  template <class Visit>
  void near_segment(Vec3 a, Vec3 b, double reach, size_t& budget, const Visit& visit) {
    const Vec3 along = b - a;
    const double squared = dot(along, along);
    if (!(squared > 0)) return;
    open_.assign(1, {{0, numbers_.size(), 0}, 0, 1});
    while (!open_.empty() && budget > 0) {
      const auto [range, t0, t1] = open_.back();
      open_.pop_back();
      if (range.from >= range.to) continue;
      --budget;
      const size_t middle = range.from + (range.to - range.from) / 2;
      const uint32_t number = numbers_[middle];
      const Vec3 p = points_[number];
      const double t = dot(p - a, along) / squared;
      if (t > 0 && t < 1 && length(a + along * t - p) <= reach) visit(number, t);
      // The part of the segment that comes near either half.
      const int axis = range.axis, next = (axis + 1) % 3;
      const double low = p[axis] + reach - a[axis], high = p[axis] - reach - a[axis];
      const double slope = along[axis];
      double low0 = t0, low1 = t1, high0 = t0, high1 = t1;
      if (slope > 0) low1 = std::min(low1, low / slope), high0 = std::max(high0, high / slope);
      if (slope < 0) low0 = std::max(low0, low / slope), high1 = std::min(high1, high / slope);
      if (low0 <= low1 && (slope != 0 || low >= 0))
        open_.push_back({{range.from, middle, next}, low0, low1});
      if (high0 <= high1 && (slope != 0 || high <= 0))
        open_.push_back({{middle + 1, range.to, next}, high0, high1});
    }
  }

 private:
  struct Range {
    size_t from, to;
    int axis;
  };
  struct Piece {
    Range range;
    double t0, t1;
  };

  std::span<const Vec3> points_;
  std::vector<uint32_t> numbers_;
  std::vector<Piece> open_;
};

/// Corners that are to be put on an edge of a triangle, from its lower to its higher corner.
struct Split {
  uint32_t triangle, a, b;
  size_t first, count;  ///< in the list of all
};

struct Splits {
  std::vector<uint32_t> corners;
  std::vector<Split> splits;
};

/// What lies on which edge. Empty if the search takes too long.
Splits find_splits(std::span<const Vec3> points, const std::vector<OpenEdge>& edges, double reach) {
  std::vector<uint32_t> corners = corners_of(edges);
  // As many as a few hundred for each, and a second or so at most.
  size_t budget = std::min<size_t>(200'000'000, 400 * corners.size() + 100'000);
  // A corner lies on few edges.
  const size_t most = 8 * corners.size() + 64;
  PointTree tree(points, std::move(corners));
  Splits found;
  std::vector<std::pair<double, uint32_t>> on;
  for (const OpenEdge& edge : edges) {
    on.clear();
    tree.near_segment(points[edge.a], points[edge.b], reach, budget,
                      [&](uint32_t number, double t) {
                        if (number != edge.a && number != edge.b) on.emplace_back(t, number);
                      });
    if (budget == 0 || found.corners.size() + on.size() > most) return {};
    if (on.empty()) continue;
    std::ranges::sort(on);
    for (const uint32_t triangle : edge.triangles)
      found.splits.push_back({triangle, edge.a, edge.b, found.corners.size(), on.size()});
    for (const auto& [t, number] : on) found.corners.push_back(number);
  }
  return found;
}

/// Splits triangles at the corners on their edges: into fans about the corner opposite of one edge
/// after the other.
void split(std::vector<Corners>& triangles, Splits& all) {
  std::ranges::stable_sort(all.splits, {}, &Split::triangle);
  std::vector<uint8_t> is_gone(triangles.size(), 0);
  const size_t before = triangles.size();
  std::vector<Corners> open;
  for (size_t i = 0; i < all.splits.size();) {
    const uint32_t triangle = all.splits[i].triangle;
    open.assign(1, triangles[triangle]);
    is_gone[triangle] = 1;
    for (; i < all.splits.size() && all.splits[i].triangle == triangle; ++i) {
      const Split& s = all.splits[i];
      // Of the parts so far exactly one has the edge.
      for (size_t k = 0; k < open.size(); ++k) {
        const Corners whole = open[k];
        size_t e = 0;
        while (e < 3 && !(std::min(whole[e], whole[(e + 1) % 3]) == s.a &&
                          std::max(whole[e], whole[(e + 1) % 3]) == s.b))
          ++e;
        if (e == 3) continue;
        const uint32_t from = whole[e], to = whole[(e + 1) % 3], apex = whole[(e + 2) % 3];
        uint32_t last = from;
        open.erase(open.begin() + std::ptrdiff_t(k));
        const auto add = [&](uint32_t corner) {
          // The triangle's own third corner may lie on its edge; then there is nothing between.
          if (corner != apex && last != apex) open.push_back({last, corner, apex});
          last = corner;
        };
        for (size_t j = 0; j < s.count; ++j)
          add(all.corners[s.first + (from == s.a ? j : s.count - 1 - j)]);
        add(to);
        break;
      }
    }
    triangles.insert(triangles.end(), open.begin(), open.end());
  }
  size_t kept = 0;
  for (size_t t = 0; t < triangles.size(); ++t)
    if (t >= before || !is_gone[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

}  // namespace

bool mend_cracks(std::span<const Vec3> points, std::vector<Corners>& triangles, double reach) {
  std::vector<OpenEdge> edges = open_edges(triangles, points.size());
  if (edges.empty() || !(reach > 0)) return false;
  const std::vector<Corners> before = triangles;
  const size_t open_before = edges.size();
  if (weld_corners(points, corners_of(edges), reach, triangles))
    edges = open_edges(triangles, points.size());
  Splits splits = find_splits(points, edges, reach);
  if (!splits.splits.empty()) {
    split(triangles, splits);
    edges = open_edges(triangles, points.size());
  }
  if (edges.size() < open_before) return true;
  triangles = before;
  return false;
}

}  // namespace whittle

#include "flat/corner_rings.h"

#include <algorithm>

namespace whittle {

namespace {

using Edge = CornerRings::Edge;

std::vector<Edge> edges_that_stay(const WeldedPolygons& polygons) {
  // Each edge with its lower point first, and whether it runs that way.
  std::vector<std::pair<Edge, int>> all;
  for (const auto& contour : polygons.contours) {
    for (size_t i = 0; i < contour.size(); ++i) {
      const uint32_t a = contour[i], b = contour[(i + 1) % contour.size()];
      if (a < b)
        all.push_back({{a, b}, 1});
      else
        all.push_back({{b, a}, -1});
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<Edge> edges;
  for (size_t i = 0; i < all.size();) {
    const Edge edge = all[i].first;
    int sum = 0;
    for (; i < all.size() && all[i].first == edge; ++i) sum += all[i].second;
    for (; sum > 0; --sum) edges.push_back(edge);
    for (; sum < 0; ++sum) edges.push_back({edge.to, edge.from});
  }
  return edges;
}

/// An edge as it is seen from one of its ends.
struct Spoke {
  uint32_t other = 0, edge = 0;
  bool out = false;
};

/// Counter-clockwise, from straight down (without it) all the way round. Points are numbered by x,
/// then by y, so those with higher numbers are to the right.
void sort_around(std::vector<Spoke>& spokes, uint32_t middle, const NumberedPoints& points) {
  std::sort(spokes.begin(), spokes.end(), [&](const Spoke& a, const Spoke& b) {
    const bool left_a = a.other < middle, left_b = b.other < middle;
    if (left_a != left_b) return left_b;
    const double turn = points.turn(middle, a.other, b.other);
    if (turn != 0) return turn > 0;
    // Between edges that lie on one another there is nothing of the region.
    if (a.out != b.out) return b.out;
    return a.edge < b.edge;
  });
}

/// Joins each way out to the first way in that is still free, as parentheses are matched.
void join(const std::vector<Spoke>& around, std::vector<uint32_t>& out_after) {
  std::vector<uint32_t> open;
  std::vector<bool> closed(around.size());
  for (size_t k = 0; k < 2 * around.size(); ++k) {
    const size_t i = k % around.size();
    const Spoke& spoke = around[i];
    if (spoke.out) {
      if (k < around.size()) open.push_back(spoke.edge);
    } else if (!closed[i] && !open.empty()) {
      out_after[spoke.edge] = open.back();
      open.pop_back();
      closed[i] = true;
    }
  }
}

}  // namespace

CornerRings::CornerRings(const WeldedPolygons& polygons, const NumberedPoints& points)
    : CornerRings(edges_that_stay(polygons), points) {}

CornerRings::CornerRings(const std::vector<Edge>& edges, const NumberedPoints& points) {
  // The spokes of each point, one after the other.
  std::vector<uint32_t> first(points.size() + 1);
  for (const Edge& edge : edges) ++first[edge.from + 1], ++first[edge.to + 1];
  for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Spoke> spokes(2 * edges.size());
  std::vector<uint32_t> end(first.begin(), first.end() - 1);
  for (uint32_t i = 0; i < edges.size(); ++i) {
    spokes[end[edges[i].from]++] = {edges[i].to, i, true};
    spokes[end[edges[i].to]++] = {edges[i].from, i, false};
  }
  std::vector<uint32_t> out_after(edges.size());
  std::vector<Spoke> around;
  for (uint32_t point = 0; point < points.size(); ++point) {
    around.assign(spokes.begin() + first[point], spokes.begin() + first[point + 1]);
    if (around.size() > 2) sort_around(around, point, points);
    join(around, out_after);
  }
  corners_.resize(edges.size());
  for (uint32_t i = 0; i < edges.size(); ++i) {
    corners_[i].point = edges[i].from;
    corners_[i].origin = i;
    corners_[i].next = out_after[i];
    corners_[out_after[i]].previous = i;
  }
}

uint32_t CornerRings::cut(uint32_t a, uint32_t b) {
  const uint32_t rest_a = size(), rest_b = rest_a + 1;
  corners_.push_back({corners_[a].point, rest_b, corners_[a].next, corners_[a].origin});
  corners_.push_back({corners_[b].point, corners_[b].previous, rest_a, corners_[b].origin});
  if (corners_[a].next == b) {
    corners_[rest_a].next = rest_b;
    corners_[rest_b].previous = rest_a;
  } else {
    corners_[corners_[rest_a].next].previous = rest_a;
    corners_[corners_[rest_b].previous].next = rest_b;
  }
  corners_[a].next = b;
  corners_[b].previous = a;
  return rest_a;
}

namespace {

/// One ring at a time; the memory is used again.
class MonotoneFiller {
 public:
  MonotoneFiller(const CornerRings& rings, const NumberedPoints& points)
      : rings_(rings), points_(points) {}

  /// `start` is the lowest point's corner and `end` the highest point's.
  void fill(uint32_t start, uint32_t end) {
    waiting_.assign(1, start);
    bool on_lower = true;
    uint32_t lower = rings_[start].next, upper = rings_[start].previous;
    while (lower != end || upper != end) {
      const bool take_lower =
          upper == end || (lower != end && rings_.point(lower) < rings_.point(upper));
      const uint32_t corner = take_lower ? lower : upper;
      lower = take_lower ? rings_[lower].next : lower;
      upper = take_lower ? upper : rings_[upper].previous;
      if (waiting_.size() > 1 && take_lower != on_lower) {
        const uint32_t last = waiting_.back();
        fan(corner, on_lower);
        waiting_.assign(1, last);
      } else {
        pop_convex(corner, take_lower);
      }
      waiting_.push_back(corner);
      on_lower = take_lower;
    }
    fan(end, on_lower);
  }

  std::vector<std::array<uint32_t, 3>> triangles;

 private:
  void emit(uint32_t a, uint32_t b, uint32_t c) {
    // The edges of a triangle that has shrunk to an edge cancel one another.
    const uint32_t p = rings_.point(a), q = rings_.point(b), r = rings_.point(c);
    if (p != q && q != r && r != p)
      triangles.push_back({rings_[a].origin, rings_[b].origin, rings_[c].origin});
  }

  /// To all that wait, which lie on the other side.
  void fan(uint32_t corner, bool waiting_on_lower) {
    for (size_t i = 0; i + 1 < waiting_.size(); ++i) {
      if (waiting_on_lower)
        emit(waiting_[i], waiting_[i + 1], corner);
      else
        emit(waiting_[i + 1], waiting_[i], corner);
    }
  }

  void pop_convex(uint32_t corner, bool lower) {
    while (waiting_.size() > 1) {
      const uint32_t before = waiting_[waiting_.size() - 2], last = waiting_.back();
      const double turn =
          points_.turn(rings_.point(before), rings_.point(last), rings_.point(corner));
      if (lower ? turn <= 0 : turn >= 0) return;
      if (lower)
        emit(before, last, corner);
      else
        emit(last, before, corner);
      waiting_.pop_back();
    }
  }

  const CornerRings& rings_;
  const NumberedPoints& points_;
  std::vector<uint32_t> waiting_;
};

}  // namespace

std::vector<std::array<uint32_t, 3>> fill_monotone(const CornerRings& rings,
                                                   const NumberedPoints& points) {
  MonotoneFiller filler(rings, points);
  std::vector<bool> seen(rings.size());
  for (uint32_t i = 0; i < rings.size(); ++i) {
    if (seen[i]) continue;
    uint32_t start = i, end = i, corner = i;
    do {
      seen[corner] = true;
      if (rings.point(corner) < rings.point(start)) start = corner;
      if (rings.point(corner) > rings.point(end)) end = corner;
      corner = rings[corner].next;
    } while (corner != i);
    if (rings.point(start) != rings.point(end)) filler.fill(start, end);
  }
  return std::move(filler.triangles);
}

}  // namespace whittle

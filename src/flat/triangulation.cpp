#include "flat/triangulation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "flat/corner_rings.h"
#include "flat/sweep_order.h"

namespace whittle {

namespace {

/// An edge that the sweep line crosses and above which the region lies. It runs to the right.
struct LowerEdge : SweptEdge {
  /// The corner, among those that the sweep has passed, from which all of the sweep line above the
  /// edge can be seen.
  uint32_t helper = 0;
  bool helper_merges = false;  ///< two parts of the region come together there
};

/// Cuts rings at the corners where they turn back, from left to right.
class MonotoneSweep {
 public:
  MonotoneSweep(CornerRings& rings, const NumberedPoints& points)
      : rings_(rings), points_(points), status_(Order{this}) {}

  void run() {
    const uint32_t count = rings_.size();
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return rings_.point(a) < rings_.point(b); });
    into_.assign(count, status_.end());
    // Cuts change only what is to the left.
    for (const uint32_t corner : order) visit(corner);
  }

 private:
  struct Order {
    using is_transparent = void;
    const MonotoneSweep* sweep;

    bool operator()(uint32_t a, uint32_t b) const { return sweep->is_below(a, b); }
    struct Corner {
      uint32_t point, previous, next;
    };
    bool operator()(uint32_t edge, const Corner& corner) const {
      return sweep->is_below(sweep->edges_[edge], corner);
    }
  };
  using Status = std::multiset<uint32_t, Order>;

  double side(const LowerEdge& edge, uint32_t point) const {
    return points_.turn(edge.from, edge.to, point);
  }

  bool is_below(uint32_t a, uint32_t b) const {
    const int order = a == b ? 0 : below(points_, edges_[a], edges_[b]);
    return order != 0 ? order > 0 : a < b;
  }

  /// Whether an edge runs below a corner whose region begins below it.
  bool is_below(const LowerEdge& edge, const Order::Corner& corner) const {
    double height = above(points_, edge, corner.point);
    // A corner that touches the edge from above lies above it.
    if (height == 0) height = side(edge, corner.previous);
    if (height == 0) height = side(edge, corner.next);
    return height > 0;
  }

  void insert(uint32_t corner) {
    const uint32_t number = uint32_t(edges_.size());
    edges_.push_back({{rings_.point(corner), rings_.next_point(corner)}, corner, false});
    into_[rings_[corner].next] = status_.insert(number);
  }

  /// Cuts from a corner to the helper if that merges. What is left of the corner after the cut.
  uint32_t close(uint32_t corner, const LowerEdge& edge) {
    return edge.helper_merges ? rings_.cut(corner, edge.helper) : corner;
  }

  /// The same for the edge that ends in a corner; the edge goes.
  uint32_t end_edge(uint32_t corner) {
    const auto edge = into_[corner];
    if (edge == status_.end()) return corner;
    const uint32_t rest = close(corner, edges_[*edge]);
    status_.erase(edge);
    return rest;
  }

  LowerEdge* edge_below(uint32_t corner) {
    const Order::Corner key = {rings_.point(corner), rings_.previous_point(corner),
                               rings_.next_point(corner)};
    const auto above = status_.lower_bound(key);
    return above == status_.begin() ? nullptr : &edges_[*std::prev(above)];
  }

  void visit(uint32_t corner) {
    const uint32_t before = rings_.previous_point(corner), here = rings_.point(corner),
                   after = rings_.next_point(corner);
    const bool convex = points_.turn(before, here, after) > 0;
    if (before < here && here < after) {  // on the lower side
      insert(end_edge(corner));
    } else if (before < here && convex) {  // the right end
      end_edge(corner);
    } else if (here < after && convex) {  // the left end
      insert(corner);
    } else {
      meet_below(corner, before < here, here < after);
    }
  }

  /// Corners that have the region below them: on its upper side, where two parts of it come
  /// together, or where it parts.
  void meet_below(uint32_t corner, bool merges, bool splits) {
    LowerEdge* below = edge_below(corner);
    uint32_t rest = merges ? end_edge(corner) : corner;
    if (below == nullptr) {
      // Only contours that cross come here.
      if (splits) insert(rest);
      return;
    }
    const uint32_t helper = rest;
    if (splits)
      rest = rings_.cut(rest, below->helper);
    else
      close(rest, *below);
    below->helper = helper;
    below->helper_merges = merges;
    if (splits) insert(rest);
  }

  CornerRings& rings_;
  const NumberedPoints& points_;
  std::vector<LowerEdge> edges_;
  Status status_;
  std::vector<Status::iterator> into_;  ///< by corner as it was at first: the edge that ends there
};

/// The points with the largest coordinate between 0.5 and 1, so that products stay in range.
std::vector<Vec2> normalized(const std::vector<Vec2>& points) {
  double most = 0;
  for (const Vec2 p : points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  const int exponent = most > 0 ? -1 - std::ilogb(most) : 0;
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const Vec2 p : points)
    result.push_back({std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)});
  return result;
}

}  // namespace

WeldedPolygons weld(const Polygons& polygons) {
  const auto less = [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  WeldedPolygons welded;
  for (const Contour& contour : polygons.contours)
    for (const Vec2 corner : contour)
      if (is_finite(corner)) welded.points.push_back(corner);
  std::stable_sort(welded.points.begin(), welded.points.end(), less);
  welded.points.erase(std::unique(welded.points.begin(), welded.points.end()), welded.points.end());
  for (const Contour& contour : polygons.contours) {
    std::vector<uint32_t> numbers;
    numbers.reserve(contour.size());
    for (const Vec2 corner : contour) {
      if (!is_finite(corner)) continue;
      const auto at = std::lower_bound(welded.points.begin(), welded.points.end(), corner, less);
      const uint32_t number = uint32_t(at - welded.points.begin());
      if (numbers.empty() || numbers.back() != number) numbers.push_back(number);
    }
    while (numbers.size() > 1 && numbers.back() == numbers.front()) numbers.pop_back();
    if (numbers.size() > 1) welded.contours.push_back(std::move(numbers));
  }
  return welded;
}

std::vector<std::array<uint32_t, 3>> triangulate(CornerRings& rings, const NumberedPoints& points) {
  MonotoneSweep(rings, points).run();
  return fill_monotone(rings, points);
}

std::vector<std::array<uint32_t, 3>> triangulate(const WeldedPolygons& polygons) {
  const std::vector<Vec2> coordinates = normalized(polygons.points);
  const PlanePoints points(coordinates);
  CornerRings rings(polygons, points);
  std::vector<std::array<uint32_t, 3>> triangles = triangulate(rings, points);
  for (std::array<uint32_t, 3>& triangle : triangles)
    for (uint32_t& corner : triangle) corner = rings.point(corner);
  return triangles;
}

std::vector<std::array<Vec2, 3>> triangulate(const Polygons& polygons) {
  const WeldedPolygons welded = weld(polygons);
  std::vector<std::array<Vec2, 3>> triangles;
  for (const auto& [a, b, c] : triangulate(welded))
    triangles.push_back({welded.points[a], welded.points[b], welded.points[c]});
  return triangles;
}

}  // namespace whittle

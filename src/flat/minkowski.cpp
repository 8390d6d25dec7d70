#include <algorithm>
#include <cmath>

#include "flat/convex_hull.h"
#include "flat/grid.h"
#include "flat/orientation.h"

namespace whittle {

namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

/// Joins many overlapping pieces: a few at first, then what came of them, so that never more than a
/// few edges of pieces cross at a time.
class Joiner {
 public:
  void add(Path piece) {
    if (!ClipperLib::Orientation(piece)) ClipperLib::ReversePath(piece);
    fresh_.push_back(std::move(piece));
    if (fresh_.size() >= kBatch) flush();
  }

  void add(Paths region) { push(std::move(region), 0); }

  Paths result() && {
    flush();
    while (regions_.size() > 1) join_last();
    return regions_.empty() ? Paths{} : std::move(regions_.back().paths);
  }

 private:
  static constexpr size_t kBatch = 64;
  struct Region {
    Paths paths;
    int level;
  };

  void flush() {
    if (fresh_.empty()) return;
    push(clip(ClipperLib::ctUnion, fresh_, {}, ClipperLib::pftNonZero), 0);
    fresh_.clear();
  }

  void push(Paths paths, int level) {
    regions_.push_back({std::move(paths), level});
    while (regions_.size() > 1 && regions_[regions_.size() - 2].level == regions_.back().level)
      join_last();
  }

  void join_last() {
    Region last = std::move(regions_.back());
    regions_.pop_back();
    Region& before = regions_.back();
    before.paths = clip(ClipperLib::ctUnion, before.paths, last.paths, ClipperLib::pftNonZero);
    ++before.level;
  }

  Paths fresh_;
  std::vector<Region> regions_;
};

IntPoint sum(const IntPoint& a, const IntPoint& b) {
  return {a.X + b.X, a.Y + b.Y};
}

/// Whether this is one contour that turns left at every corner, and once around.
bool is_convex(const Polygons& polygons) {
  if (polygons.contours.size() != 1) return false;
  const Contour& contour = polygons.contours.front();
  return hull_contour(contour).size() == contour.size();
}

/// Of convex contours: their edges, one after the other by direction.
Contour convex_sum(const Contour& a, const Contour& b) {
  // Both from the leftmost corner, as a hull begins.
  const Contour p = hull_contour(a), q = hull_contour(b);
  Contour sums;
  for (size_t i = 0, j = 0; i < p.size() || j < q.size();) {
    const Vec2 at_p = p[i % p.size()], at_q = q[j % q.size()];
    sums.push_back(at_p + at_q);
    const double turn = cross(p[(i + 1) % p.size()] - at_p, q[(j + 1) % q.size()] - at_q);
    const bool step_p = j == q.size() || (i < p.size() && turn >= 0);
    const bool step_q = i == p.size() || (j < q.size() && turn <= 0);
    i += step_p;
    j += step_q;
  }
  return hull_contour(std::move(sums));
}

/// What a convex shape sweeps along an edge.
Path swept(const Path& convex, const IntPoint& from, const IntPoint& to) {
  std::vector<Vec2> points;
  points.reserve(2 * convex.size());
  for (const IntPoint& corner : convex)
    for (const IntPoint& end : {from, to})
      points.push_back({double(corner.X + end.X), double(corner.Y + end.Y)});
  Path path;
  for (const Vec2 p : hull_contour(std::move(points)))
    path.emplace_back(ClipperLib::cInt(p.x), ClipperLib::cInt(p.y));
  return path;
}

template <class Visit>
void for_each_edge(const Paths& paths, const Visit& visit) {
  for (const Path& path : paths)
    for (size_t i = 0; i < path.size(); ++i) visit(path[i], path[(i + 1) % path.size()]);
}

/// One copy of `shape` for each piece of `places`, standing on a corner of it.
void add_copies(const Paths& shape, const Paths& places, Joiner& joiner) {
  for (const Path& place : places) {
    if (!ClipperLib::Orientation(place)) continue;
    Paths copy = shape;
    for (Path& path : copy)
      for (IntPoint& corner : path) corner = sum(corner, place.front());
    joiner.add(std::move(copy));
  }
}

/// A point is in the sum if the second shape, turned by half a turn and moved there, meets the
/// first: then either their outlines cross, or a piece of one lies in the other. So the sum is
/// what one outline sweeps along the other, and a copy of each shape for each piece of the other.
Polygons sum_of_two(const Polygons& a, const Polygons& b) {
  if (a.is_empty() || b.is_empty()) return {};
  if (is_convex(a) && is_convex(b)) return {{convex_sum(a.contours.front(), b.contours.front())}};
  const std::span<const Polygons> first(&a, 1), second(&b, 1);
  Grid grid(reach(first) + reach(second));
  const Paths p = sanitized(grid.to_grid(a)), q = sanitized(grid.to_grid(b));
  Grid sums(reach(first) + reach(second));
  Joiner joiner;
  if (is_convex(a) || is_convex(b)) {
    const bool a_is = is_convex(a);
    const Paths& convex = a_is ? p : q;
    if (convex.empty()) return {};
    for_each_edge(a_is ? q : p, [&](const IntPoint& from, const IntPoint& to) {
      joiner.add(swept(convex.front(), from, to));
    });
  } else {
    for_each_edge(p, [&](const IntPoint& a0, const IntPoint& a1) {
      for_each_edge(q, [&](const IntPoint& b0, const IntPoint& b1) {
        joiner.add({sum(a0, b0), sum(a1, b0), sum(a1, b1), sum(a0, b1)});
      });
    });
  }
  add_copies(p, q, joiner);
  add_copies(q, p, joiner);
  return sums.from_grid(std::move(joiner).result());
}

}  // namespace

Polygons minkowski_sum(std::span<const Polygons> operands) {
  if (operands.empty()) return {};
  Polygons total = unite(operands.first(1));
  for (size_t i = 1; i < operands.size(); ++i) {
    total = sum_of_two(total, unite(operands.subspan(i, 1)));
  }
  return total;
}

}  // namespace whittle

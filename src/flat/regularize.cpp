#include "flat/regularize.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "flat/corner_rings.h"
#include "flat/sweep_order.h"
#include "flat/triangulation.h"

namespace whittle {

namespace {

using ClipperLib::cInt;
using ClipperLib::Path;
using ClipperLib::Paths;

struct WoundEdge : SweptEdge {
  int step = 0;   ///< by which the winding number is greater above than below
  int above = 0;  ///< the winding number there
};

/// In the order of their first points, and around these counter-clockwise.
std::vector<WoundEdge> wound_edges(const WeldedPolygons& polygons) {
  std::vector<WoundEdge> all;
  for (const auto& contour : polygons.contours) {
    for (size_t i = 0; i < contour.size(); ++i) {
      const uint32_t a = contour[i], b = contour[(i + 1) % contour.size()];
      all.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1, 0});
    }
  }
  std::sort(all.begin(), all.end(), [](const WoundEdge& e, const WoundEdge& f) {
    return e.from != f.from ? e.from < f.from : e.to < f.to;
  });
  std::vector<WoundEdge> edges;
  for (const WoundEdge& edge : all) {
    if (!edges.empty() && edges.back().from == edge.from && edges.back().to == edge.to)
      edges.back().step += edge.step;
    else
      edges.push_back(edge);
  }
  std::erase_if(edges, [](const WoundEdge& edge) { return edge.step == 0; });
  std::stable_sort(edges.begin(), edges.end(), [&](const WoundEdge& e, const WoundEdge& f) {
    if (e.from != f.from) return e.from < f.from;
    return orientation(polygons.points[e.from], polygons.points[e.to], polygons.points[f.to]) > 0;
  });
  return edges;
}

/// Finds `above` of all edges.
class WindingSweep {
 public:
  WindingSweep(std::vector<WoundEdge>& edges, const NumberedPoints& points)
      : edges_(edges), points_(points), status_(Order{this}) {}

  void run() {
    std::vector<std::vector<Status::iterator>> ending(points_.size());
    uint32_t next = 0;
    for (uint32_t point = 0; point < points_.size(); ++point) {
      for (const Status::iterator edge : ending[point]) status_.erase(edge);
      const auto higher = status_.lower_bound(Point{point});
      int winding = higher == status_.begin() ? 0 : edges_[*std::prev(higher)].above;
      for (; next < edges_.size() && edges_[next].from == point; ++next) {
        winding += edges_[next].step;
        edges_[next].above = winding;
        ending[edges_[next].to].push_back(status_.insert(next));
      }
    }
  }

 private:
  struct Point {
    uint32_t number;
  };
  struct Order {
    using is_transparent = void;
    const WindingSweep* sweep;

    bool operator()(uint32_t a, uint32_t b) const {
      const int order = a == b ? 0 : below(sweep->points_, sweep->edges_[a], sweep->edges_[b]);
      return order != 0 ? order > 0 : a < b;
    }
    bool operator()(uint32_t edge, Point point) const {
      return above(sweep->points_, sweep->edges_[edge], point.number) > 0;
    }
  };
  using Status = std::multiset<uint32_t, Order>;

  std::vector<WoundEdge>& edges_;
  const NumberedPoints& points_;
  Status status_;
};

/// Whether there is nothing of the region below and its first layer above, or the other way round.
bool is_outline(const WoundEdge& edge) {
  return (edge.step == 1 && edge.above == 1) || (edge.step == -1 && edge.above == 0);
}

Paths contours(const CornerRings& rings, const std::vector<Vec2>& points) {
  Paths result;
  std::vector<bool> seen(rings.size());
  for (uint32_t i = 0; i < rings.size(); ++i) {
    if (seen[i]) continue;
    Path path;
    for (uint32_t corner = i; !seen[corner]; corner = rings[corner].next) {
      seen[corner] = true;
      const Vec2 p = points[rings.point(corner)];
      path.emplace_back(cInt(p.x), cInt(p.y));
    }
    result.push_back(std::move(path));
  }
  return result;
}

WeldedPolygons welded(const Paths& paths) {
  Polygons polygons;
  for (const Path& path : paths) {
    Contour& contour = polygons.contours.emplace_back();
    for (const ClipperLib::IntPoint& p : path) contour.push_back({double(p.X), double(p.Y)});
  }
  return weld(polygons);
}

}  // namespace

Paths regularized(Paths paths) {
  const WeldedPolygons polygons = welded(paths);
  std::vector<WoundEdge> edges = wound_edges(polygons);
  const PlanePoints points(polygons.points);
  WindingSweep(edges, points).run();
  size_t written = 0;
  for (const Path& path : paths) written += path.size();
  if (edges.size() == written && std::all_of(edges.begin(), edges.end(), is_outline)) return paths;
  std::vector<CornerRings::Edge> outline;
  for (const WoundEdge& edge : edges) {
    const bool inside_above = edge.above != 0, inside_below = edge.above != edge.step;
    if (inside_above == inside_below) continue;
    if (inside_above)
      outline.push_back({edge.from, edge.to});
    else
      outline.push_back({edge.to, edge.from});
  }
  return contours(CornerRings(outline, points), polygons.points);
}

}  // namespace whittle

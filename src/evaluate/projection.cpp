#include "evaluate/projection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/box.h"
#include "evaluate/convex_hull.h"
#include "flat/convex_hull.h"
#include "model/instances.h"

namespace whittle {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;  ///< from corner to corner

/// The edges of the triangles for which `is_wanted` holds, without those that two of them share.
template <class IsWanted>
std::vector<Edge> outline_edges(const TriangleMesh& mesh, const IsWanted& is_wanted) {
  struct Half {
    uint32_t low, high;
    bool rises;
  };
  std::vector<Half> halves;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    if (!is_wanted(t)) continue;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = t.corners[k], to = t.corners[(k + 1) % 3];
      halves.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  const auto key = [](const Half& half) { return std::pair(half.low, half.high); };
  std::sort(halves.begin(), halves.end(),
            [&](const Half& a, const Half& b) { return key(a) < key(b); });
  std::vector<Edge> edges;
  for (size_t first = 0, end = 0; first < halves.size(); first = end) {
    int rising = 0;
    for (end = first; end < halves.size() && key(halves[end]) == key(halves[first]); ++end)
      rising += halves[end].rises ? 1 : -1;
    const auto [low, high] = key(halves[first]);
    for (; rising > 0; --rising) edges.emplace_back(low, high);
    for (; rising < 0; ++rising) edges.emplace_back(high, low);
  }
  return edges;
}

/// As many edges end in each corner as begin there, so walks along them come back.
std::vector<Contour> loops(std::span<const Vec3> points, std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end());
  const auto first_from = [&](uint32_t corner) {
    return size_t(std::lower_bound(edges.begin(), edges.end(), Edge{corner, 0}) - edges.begin());
  };
  // How many edges from a corner have been walked along, by the first of them.
  std::vector<uint32_t> walked(edges.size());
  std::vector<Contour> all;
  for (size_t first = 0; first < edges.size(); ++first) {
    const uint32_t start = edges[first].first;
    if (first != first_from(start)) continue;
    const auto has_more = [&](size_t at, uint32_t corner) {
      const size_t next = at + walked[at];
      return next < edges.size() && edges[next].first == corner;
    };
    while (has_more(first, start)) {
      Contour loop;
      uint32_t corner = start;
      size_t at = first;
      do {
        const Vec3 p = points[corner];
        loop.push_back({p.x, p.y});
        corner = edges[at + walked[at]++].second;
        at = first_from(corner);
      } while (corner != start);
      all.push_back(std::move(loop));
    }
  }
  return all;
}

/// Where an edge meets z = 0; its ends are not on one side of it.
Vec3 crossing(Vec3 a, Vec3 b) {
  if (a.z == 0) return a;
  if (b.z == 0) return b;
  const Vec3 p = a + (b - a) * (a.z / (a.z - b.z));
  return {p.x, p.y, 0};
}

Polygons section_of_convex(std::span<const Vec3> points) {
  const std::optional<Polyhedron> solid = solid_hull(points);
  if (!solid) return {};
  std::vector<Vec2> corners;
  for (const std::vector<uint32_t>& face : solid->faces) {
    for (size_t k = 0; k < face.size(); ++k) {
      const Vec3 a = solid->points[face[k]], b = solid->points[face[(k + 1) % face.size()]];
      if ((a.z < 0 && b.z < 0) || (a.z > 0 && b.z > 0)) continue;
      const Vec3 p = crossing(a, b);
      corners.push_back({p.x, p.y});
    }
  }
  Contour outline = hull_contour(std::move(corners));
  if (outline.empty()) return {};
  return {{std::move(outline)}};
}

/// Loops where a surface goes through the plane z = 0. Corners in the plane count as below it if
/// `level_is_below`, else as above.
std::vector<Contour> section_loops(const SolidPart& part, std::span<const Vec3> points,
                                   bool level_is_below) {
  const auto is_above = [&](uint32_t corner) {
    return level_is_below ? points[corner].z > 0 : points[corner].z >= 0;
  };
  std::map<Edge, uint32_t> numbers;
  std::vector<Vec3> crossings;
  const auto number_of = [&](uint32_t a, uint32_t b) {
    const auto [place, is_new] = numbers.try_emplace(std::minmax(a, b), uint32_t(crossings.size()));
    if (is_new)
      crossings.push_back(crossing(points[place->first.first], points[place->first.second]));
    return place->second;
  };
  std::vector<Edge> edges;
  for (const TriangleMesh::Triangle& t : part.triangles) {
    std::optional<uint32_t> down, up;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t.corners[k], b = t.corners[(k + 1) % 3];
      if (is_above(a) && !is_above(b)) down = number_of(a, b);
      if (!is_above(a) && is_above(b)) up = number_of(a, b);
    }
    if (down && up) edges.emplace_back(*down, *up);
  }
  return loops(crossings, std::move(edges));
}

}  // namespace

std::vector<Contour> shadow_outlines(const TriangleMesh& mesh) {
  const auto looks_up = [&](const TriangleMesh::Triangle& t) {
    const Vec3 a = mesh.points[t.corners[0]], b = mesh.points[t.corners[1]],
               c = mesh.points[t.corners[2]];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  return loops(mesh.points, outline_edges(mesh, looks_up));
}

Polygons section_of(const SolidPart& part, Budget& budget) {
  Box box;
  for (const Vec3 p : part.points) box.include(p);
  const double near = kRelativeTolerance * max_component(box.size());
  if (box.is_empty() || box.lo.z > near || box.hi.z < -near) return {};
  std::vector<Vec3> points = part.points;
  bool has_level = false;
  for (Vec3& p : points) {
    if (std::fabs(p.z) > near) continue;
    p.z = 0;
    has_level = true;
  }
  if (part.is_convex()) return section_of_convex(points);
  std::vector<Polygons> sides;
  for (const bool level_is_below : {true, false}) {
    if (!level_is_below && !has_level) break;
    const std::vector<Contour> outlines = section_loops(part, points, level_is_below);
    if (!budget.sweep(outlines)) return {};
    sides.push_back(nonzero(outlines));
  }
  return unite(sides);
}

}  // namespace whittle

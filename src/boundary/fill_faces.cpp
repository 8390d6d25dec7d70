#include "boundary/fill_faces.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/disjoint_sets.h"
#include "flat/corner_rings.h"

namespace whittle {
namespace {

/// The points of one sheet, numbered as they lie in its plane.
class SheetPoints final : public NumberedPoints {
 public:
  SheetPoints(std::span<const HalfEdge> edges, std::span<const ExactPoint> points,
              const ExactGeometry& geometry)
      : geometry_(geometry) {
    const Sheet sheet = edges[0].sheet;
    const ExactPlane& plane = geometry.plane(sheet >> 1);
    const int axis = largest_axis(plane);
    u_ = (axis + 1) % 3, v_ = (axis + 2) % 3;
    if ((plane.n[size_t(axis)] < 0) != bool(sheet & 1)) std::swap(u_, v_);
    numbers_.reserve(edges.size());
    for (const HalfEdge& edge : edges) numbers_.push_back(edge.from);
    std::sort(numbers_.begin(), numbers_.end());
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    std::vector<uint32_t> order = numbers_;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const int by_u = geometry.compare(points[a], points[b], u_);
      return by_u != 0 ? by_u < 0 : geometry.compare(points[a], points[b], v_) < 0;
    });
    ranks_.resize(order.size());
    points_.reserve(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
      ranks_[place_of(order[i])] = i;
      points_.push_back(&points[order[i]]);
    }
  }

  size_t size() const override { return points_.size(); }
  double turn(uint32_t a, uint32_t b, uint32_t c) const override {
    return geometry_.turn(*points_[a], *points_[b], *points_[c], u_, v_);
  }
  uint32_t rank_of(uint32_t point) const { return ranks_[place_of(point)]; }

 private:
  size_t place_of(uint32_t point) const {
    return size_t(std::lower_bound(numbers_.begin(), numbers_.end(), point) - numbers_.begin());
  }

  const ExactGeometry& geometry_;
  int u_, v_;
  std::vector<uint32_t> numbers_, ranks_;
  std::vector<const ExactPoint*> points_;
};

}  // namespace

FilledFaces fill(const FaceOutlines& outlines, const ExactGeometry& geometry,
                 const Workers& workers) {
  const std::vector<HalfEdge>& edges = outlines.edges;
  std::vector<uint32_t> firsts;
  for (uint32_t i = 0; i < edges.size(); ++i)
    if (i == 0 || edges[i].sheet != edges[i - 1].sheet) firsts.push_back(i);
  firsts.push_back(uint32_t(edges.size()));

  // Corners are named by the edges that leave them.
  FilledFaces result;
  result.next.resize(edges.size());
  std::vector<std::vector<std::array<uint32_t, 3>>> filled(firsts.size() - 1);
  workers.for_parts(filled.size(), 16, [&](size_t begin, size_t end, size_t) {
    std::vector<CornerRings::Edge> ring_edges;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t first = firsts[i];
      const auto on_sheet = std::span(edges).subspan(first, firsts[i + 1] - first);
      const SheetPoints points(on_sheet, outlines.points, geometry);
      ring_edges.clear();
      for (const HalfEdge& edge : on_sheet)
        ring_edges.push_back({points.rank_of(edge.from), points.rank_of(edge.to)});
      CornerRings rings(ring_edges, points);
      for (uint32_t k = 0; k < on_sheet.size(); ++k) result.next[first + k] = first + rings[k].next;
      filled[i] = triangulate(rings, points);
      for (std::array<uint32_t, 3>& triangle : filled[i])
        for (uint32_t& corner : triangle) corner += first;
    }
  });

  // Around a point, across the edges that meet there.
  DisjointSets fans(edges.size());
  for (uint32_t i = 0; i < edges.size(); ++i) fans.join(i, result.next[edges[i].twin]);
  std::vector<uint32_t> corners(edges.size(), UINT32_MAX);  // by what stands for a fan
  result.fans.resize(edges.size());
  for (uint32_t i = 0; i < edges.size(); ++i) {
    uint32_t& corner = corners[fans.find(i)];
    if (corner == UINT32_MAX) {
      corner = uint32_t(result.points.size());
      result.points.push_back(edges[i].from);
    }
    result.fans[i] = corner;
  }
  for (size_t i = 0; i < filled.size(); ++i)
    for (const std::array<uint32_t, 3>& triangle : filled[i])
      result.triangles.push_back({triangle, edges[firsts[i]].sheet});
  return result;
}

}  // namespace whittle

#include "boundary/finish.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "boundary/numbering.h"

namespace whittle {
namespace {

/// A solid that touches itself along an edge has that edge twice. Where its ends are the same
/// corners both times, all but one of them get a corner of their own in the middle.
class EdgeSplitter {
 public:
  EdgeSplitter(const FilledFaces& filled, const FaceOutlines& outlines, SolidMesh& mesh)
      : filled_(filled), outlines_(outlines), mesh_(mesh) {}

  void run(const Workers& workers) {
    const std::vector<Edge> repeated = repeated_edges(workers);
    if (repeated.empty()) return;
    for (const FilledFaces::Triangle& triangle : filled_.triangles)
      named_.push_back(triangle.corners);
    next_name_ = uint32_t(filled_.next.size());
    for (uint32_t i = 0; i < named_.size(); ++i) note(i);
    for (const Edge& edge : repeated) split(edge);
  }

 private:
  /// An edge of a triangle, from one of its corners (0 to 2) to the next.
  struct Edge {
    uint32_t low, high;  ///< corners of the mesh
    uint32_t from, to;   ///< the same as the outlines' corners
    bool operator<(const Edge& other) const {
      return low != other.low ? low < other.low : high < other.high;
    }
  };

  /// Of edges that are there more than once, all but the first, each as it runs from low to high.
  std::vector<Edge> repeated_edges(const Workers& workers) const {
    std::vector<Edge> edges;
    for (const FilledFaces::Triangle& triangle : filled_.triangles) {
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = triangle.corners[i], to = triangle.corners[(i + 1) % 3];
        const uint32_t a = filled_.fans[from], b = filled_.fans[to];
        if (a < b) edges.push_back({a, b, from, to});
      }
    }
    constexpr size_t kCorners = 256;
    Buckets by_corner = sort_into_buckets(
        edges.size(), filled_.points.size() / kCorners + 1,
        [&](size_t i) { return edges[i].low / kCorners; }, workers);
    std::vector<std::vector<Edge>> found(by_corner.count());
    workers.for_parts(by_corner.count(), 16, [&](size_t begin, size_t end, size_t) {
      for (size_t b = begin; b < end; ++b) {
        const auto first = by_corner.items.begin() + std::ptrdiff_t(by_corner.firsts[b]),
                   last = by_corner.items.begin() + std::ptrdiff_t(by_corner.firsts[b + 1]);
        std::sort(first, last, [&](uint32_t x, uint32_t y) {
          return edges[x] < edges[y] || (!(edges[y] < edges[x]) && x < y);
        });
        for (auto i = first; i != last; ++i)
          if (i != first && !(edges[*(i - 1)] < edges[*i])) found[b].push_back(edges[*i]);
      }
    });
    std::vector<Edge> repeated;
    for (const std::vector<Edge>& some : found)
      repeated.insert(repeated.end(), some.begin(), some.end());
    return repeated;
  }

  static uint64_t key(uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; }

  void note(uint32_t triangle) {
    const std::array<uint32_t, 3>& corners = named_[triangle];
    for (size_t i = 0; i < 3; ++i) by_edge_[key(corners[i], corners[(i + 1) % 3])] = triangle;
  }

  void split(const Edge& edge) {
    const auto middle = uint32_t(mesh_.corners.size());
    mesh_.corners.push_back((mesh_.corners[edge.low] + mesh_.corners[edge.high]) / 2);
    const uint32_t name = next_name_++;
    split_triangle(edge.from, edge.to, middle, name);
    // Its other side is in the same face, or is the twin of an outline's edge.
    if (by_edge_.contains(key(edge.to, edge.from))) {
      split_triangle(edge.to, edge.from, middle, name);
    } else {
      const uint32_t twin = outlines_.edges[edge.from].twin;
      split_triangle(twin, filled_.next[twin], middle, name);
    }
  }

  void split_triangle(uint32_t from, uint32_t to, uint32_t middle, uint32_t name) {
    const uint32_t whole = by_edge_.at(key(from, to)), rest = uint32_t(named_.size());
    named_.push_back(named_[whole]);
    mesh_.triangles.push_back(mesh_.triangles[whole]);
    for (size_t i = 0; i < 3; ++i) {
      if (named_[whole][i] == to) {
        named_[whole][i] = name;
        mesh_.triangles[whole].corners[i] = middle;
      }
      if (named_[rest][i] == from) {
        named_[rest][i] = name;
        mesh_.triangles[rest].corners[i] = middle;
      }
    }
    note(whole);
    note(rest);
  }

  const FilledFaces& filled_;
  const FaceOutlines& outlines_;
  SolidMesh& mesh_;
  std::vector<std::array<uint32_t, 3>> named_;  ///< the triangles by names of corners
  std::unordered_map<uint64_t, uint32_t> by_edge_;
  uint32_t next_name_ = 0;
};

Vec3 rounded(const ExactPoint& point, double per_unit) {
  Vec3 p;
  for (int i = 0; i < 3; ++i)
    p[i] = std::ldexp(double(point.floor[size_t(i)]), -ExactPoint::kFractionBits) / per_unit;
  return p;
}

}  // namespace

SolidMesh finish(const FilledFaces& filled, const FaceOutlines& outlines,
                 const std::vector<Pieces::Owner>& owners, const std::vector<uint32_t>& half_spaces,
                 const ExactGeometry& geometry, double per_unit, Vec3 origin,
                 const Workers& workers) {
  SolidMesh mesh;
  mesh.corners.reserve(filled.points.size());
  for (const uint32_t point : filled.points)
    mesh.corners.push_back(rounded(outlines.points[point], per_unit) + origin);
  mesh.triangles.reserve(filled.triangles.size());
  Sheet last = UINT32_MAX;
  auto owner = owners.begin();
  for (const FilledFaces::Triangle& triangle : filled.triangles) {
    if (triangle.sheet != last) {
      last = triangle.sheet;
      const std::array<int64_t, 3>& n = geometry.plane(last >> 1).n;
      const Vec3 normal = normalize(Vec3{double(n[0]), double(n[1]), double(n[2])});
      while (owner->sheet != last) ++owner;
      mesh.faces.push_back({.outward = last & 1 ? -normal : normal,
                            .owner = owner->id,
                            .half_space = half_spaces[last >> 1],
                            .color = {}});
    }
    SolidMesh::Triangle numbered{{}, uint32_t(mesh.faces.size()) - 1};
    for (size_t i = 0; i < 3; ++i) numbered.corners[i] = filled.fans[triangle.corners[i]];
    mesh.triangles.push_back(numbered);
  }
  EdgeSplitter(filled, outlines, mesh).run(workers);
  return mesh;
}

}  // namespace whittle

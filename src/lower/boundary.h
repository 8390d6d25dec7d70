// The surface of a body that is no conjunction of half-spaces, as triangles in a tree of boxes:
// which of them reach a box, and whether a point is inside.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/affine.h"
#include "base/box.h"
#include "base/workers.h"
#include "lower/clip_polygon.h"
#include "shape/triangle_mesh.h"

namespace whittle {

class Boundary {
 public:
  struct Triangle {
    std::array<uint32_t, 3> corners{};  ///< counter-clockwise seen from outside
    uint32_t face = 0;                  ///< into Scene::faces
  };

  /// `first_face`: into Scene::faces, where the mesh's facets stand. Precondition: the map is
  /// invertible, the mesh has triangles.
  Boundary(const TriangleMesh& mesh, const Affine& local_from_mesh, uint32_t first_face);

  Vec3 point(uint32_t corner) const { return points_[corner]; }
  std::span<const Triangle> triangles() const { return triangles_; }

  /// In the region that is looked at, triangles are no farther than this from the planes of their
  /// faces.
  double slack() const { return slack_; }
  /// No distance below this can be told from zero.
  double rounding() const { return rounding_; }
  /// Measures the slack again. `distance(face, point)` is that of a point from the plane of a face.
  /// The slack is at least `rounding`. (Two planes that are one in the region may part far beyond
  /// it.)
  template <class Distance>
  void measure_slack(double rounding, const Box& region, const Workers* workers,
                     const Distance& distance);

  /// Calls visit(index into triangles()) for the triangles that reach a box, until it returns
  /// false. The test is exact but for rounding: the box should be a little larger than what
  /// matters.
  template <class Visit>
  void visit_in(Vec3 center, Vec3 half, const Visit& visit) const;
  /// The same for those among some triangles.
  template <class Visit>
  void visit_in(std::span<const uint32_t> some, Vec3 center, Vec3 half, const Visit& visit) const {
    for (const uint32_t i : some)
      if (reaches(triangles_[i], center, half) && !visit(i)) return;
  }

  /// The winding number at a point. Of a point closer to a triangle than rounding it is one of the
  /// numbers near it.
  ///
  /// Counts what is above the point. Edges are looked at as if the point were moved by an
  /// infinitesimal (Edelsbrunner and Muecke, Simulation of Simplicity, 1990), so that a line along
  /// an edge or through a corner meets just one of the triangles there.
  int winding(Vec3 p) const;

 private:
  /// Single precision, rounded outwards.
  struct Node {
    std::array<float, 3> lo, hi;
    uint32_t first;  ///< leaf: the first triangle; else: the first of two children in a row
    uint32_t count;  ///< leaf: triangles; else 0
  };
  /// Of a triangle, seen from above, and its top; rounded outwards.
  struct Column {
    float lo_x, hi_x, lo_y, hi_y, top;
  };
  static constexpr uint32_t kLeafTriangles = 4;
  static constexpr size_t kMostDepth = 96;

  /// Of some triangles.
  template <class Distance>
  double slack_of(std::span<const Triangle> triangles, double rounding, const Box& region,
                  const Distance& distance) const;
  void build();
  /// Calls visit(index) for the triangles of all leaves, but for what lies under a node with
  /// is_beside(node), until it returns false.
  template <class IsBeside, class Visit>
  void visit_leaves(const IsBeside& is_beside, const Visit& visit) const;
  bool reaches(const Triangle& triangle, Vec3 center, Vec3 half) const;
  int crosses_above(const Triangle& triangle, Vec3 p) const;

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;  ///< in the order of the leaves
  std::vector<Column> columns_;      ///< by triangle: for most the column alone decides
  std::vector<Node> nodes_;          ///< the root first
  double slack_ = 0, rounding_ = 0;
};

template <class Distance>
void Boundary::measure_slack(double rounding, const Box& region, const Workers* workers,
                             const Distance& distance) {
  constexpr size_t kEach = size_t(1) << 13;
  std::vector<double> slacks((triangles_.size() + kEach - 1) / kEach, rounding);
  for_parts(workers, slacks.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t part = first; part < last; ++part) {
      const size_t begin = part * kEach;
      slacks[part] = slack_of(
          std::span(triangles_).subspan(begin).first(std::min(kEach, triangles_.size() - begin)),
          rounding, region, distance);
    }
  });
  rounding_ = rounding;
  slack_ = *std::max_element(slacks.begin(), slacks.end());
}

template <class Distance>
double Boundary::slack_of(std::span<const Triangle> triangles, double rounding, const Box& region,
                          const Distance& distance) const {
  double slack = rounding;
  std::vector<Vec3> cut;
  for (const Triangle& triangle : triangles) {
    double off = 0;
    bool is_within = true;
    for (const uint32_t corner : triangle.corners) {
      off = std::max(off, distance(triangle.face, points_[corner]));
      is_within = is_within && region.contains(points_[corner]);
    }
    if (!(2 * off > slack)) continue;
    if (!is_within) {
      off = 0;
      cut.clear();
      for (const uint32_t corner : triangle.corners)
        cut.push_back(points_[corner] - region.center());
      clip_to_box(cut, region.size() / 2);
      for (const Vec3& p : cut) off = std::max(off, distance(triangle.face, p + region.center()));
    }
    slack = std::max(slack, 2 * off);
  }
  return slack;
}

template <class IsBeside, class Visit>
void Boundary::visit_leaves(const IsBeside& is_beside, const Visit& visit) const {
  std::array<uint32_t, kMostDepth> open;
  size_t count = 0;
  const auto add = [&](uint32_t number) {
    if (!is_beside(nodes_[number])) open[count++] = number;
  };
  add(0);
  while (count > 0) {
    const Node& node = nodes_[open[--count]];
    if (node.count == 0) {
      add(node.first + 1);
      add(node.first);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      if (!visit(i)) return;
  }
}

template <class Visit>
void Boundary::visit_in(Vec3 center, Vec3 half, const Visit& visit) const {
  const Vec3 lo = center - half, hi = center + half;
  const auto is_beside = [&](const Node& node) {
    return hi.x < double(node.lo[0]) || lo.x > double(node.hi[0]) || hi.y < double(node.lo[1]) ||
           lo.y > double(node.hi[1]) || hi.z < double(node.lo[2]) || lo.z > double(node.hi[2]);
  };
  visit_leaves(is_beside,
               [&](uint32_t i) { return !reaches(triangles_[i], center, half) || visit(i); });
}

}  // namespace whittle

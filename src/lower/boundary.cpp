#include "lower/boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whittle {
namespace {

float rounded_down(double x) {
  const float f = float(x);
  return double(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float rounded_up(double x) {
  const float f = float(x);
  return double(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// Twice the area of a, b, p seen from above: positive if p is to the left of the way from a to b.
/// Where it is none, its sign once p is moved a little along x, and along y by much less.
int side_of(Vec3 a, Vec3 b, Vec3 p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double area = dx * (p.y - a.y) - dy * (p.x - a.x);
  if (area != 0) return area > 0 ? 1 : -1;
  if (dy != 0) return dy < 0 ? 1 : -1;
  return dx > 0 ? 1 : dx < 0 ? -1 : 0;
}

}  // namespace

Boundary::Boundary(const TriangleMesh& mesh, const Affine& local_from_mesh, uint32_t first_face) {
  points_.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) points_.push_back(local_from_mesh.point(p));
  const bool turned = local_from_mesh.determinant() < 0;
  triangles_.reserve(mesh.triangles.size());
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const auto& [a, b, c] = t.corners;
    triangles_.push_back(
        {turned ? std::array{a, c, b} : std::array{a, b, c}, first_face + t.facet});
  }
  build();
}

/// Halves the box of the triangles' middles along its longest edge, again and again; where that
/// parts nothing, or would go too deep, the row of triangles is halved.
void Boundary::build() {
  struct Item {
    Vec3 middle;  ///< times three
    uint32_t triangle;
  };
  std::vector<Item> items(triangles_.size());
  for (uint32_t i = 0; i < items.size(); ++i) {
    const auto& [a, b, c] = triangles_[i].corners;
    items[i] = {points_[a] + points_[b] + points_[c], i};
  }
  struct Open {
    uint32_t node, first, last, depth;
  };
  constexpr uint32_t kDeep = 48;
  nodes_.reserve(2 * items.size() / kLeafTriangles + 2);
  nodes_.push_back({});
  std::vector<Open> open{{0, 0, uint32_t(items.size()), 0}};
  while (!open.empty()) {
    const Open part = open.back();
    open.pop_back();
    Box middles;
    for (uint32_t i = part.first; i < part.last; ++i) middles.include(items[i].middle);
    if (part.last - part.first <= kLeafTriangles) {
      nodes_[part.node].first = part.first;
      nodes_[part.node].count = part.last - part.first;
      continue;
    }
    const Vec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double cut = middles.center()[axis];
    const auto begin = items.begin() + part.first, end = items.begin() + part.last;
    auto middle = std::partition(begin, end, [&](const Item& i) { return i.middle[axis] < cut; });
    if (middle == begin || middle == end || part.depth >= kDeep) {
      middle = begin + (end - begin) / 2;
      std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) {
        return a.middle[axis] < b.middle[axis];
      });
    }
    const auto cut_at = uint32_t(middle - items.begin());
    const auto children = uint32_t(nodes_.size());
    nodes_[part.node].first = children;
    nodes_[part.node].count = 0;
    nodes_.push_back({});
    nodes_.push_back({});
    open.push_back({children + 1, cut_at, part.last, part.depth + 1});
    open.push_back({children, part.first, cut_at, part.depth + 1});
  }
  std::vector<Triangle> sorted;
  sorted.reserve(triangles_.size());
  for (const Item& item : items) sorted.push_back(triangles_[item.triangle]);
  triangles_ = std::move(sorted);
  columns_.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_) {
    Box box;
    for (const uint32_t corner : triangle.corners) box.include(points_[corner]);
    columns_.push_back({rounded_down(box.lo.x), rounded_up(box.hi.x), rounded_down(box.lo.y),
                        rounded_up(box.hi.y), rounded_up(box.hi.z)});
  }
  // Children stand behind their parents.
  for (size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.count == 0) {
      const Node &a = nodes_[node.first], &b = nodes_[node.first + 1];
      for (size_t axis = 0; axis < 3; ++axis) {
        node.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
        node.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
      }
      continue;
    }
    Box box;
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      for (const uint32_t corner : triangles_[i].corners) box.include(points_[corner]);
    for (int axis = 0; axis < 3; ++axis) {
      node.lo[size_t(axis)] = rounded_down(box.lo[axis]);
      node.hi[size_t(axis)] = rounded_up(box.hi[axis]);
    }
  }
}

/// Separating axes of a box and a triangle: the box's three, the triangle's normal, and the nine
/// that are square to an edge of each (Akenine-Moeller, Fast 3D triangle-box overlap testing,
/// 2001).
bool Boundary::reaches(const Triangle& triangle, Vec3 center, Vec3 half) const {
  const Vec3 v[3] = {points_[triangle.corners[0]] - center, points_[triangle.corners[1]] - center,
                     points_[triangle.corners[2]] - center};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = v[0][axis], b = v[1][axis], c = v[2][axis];
    if (std::min(a, std::min(b, c)) > half[axis] || std::max(a, std::max(b, c)) < -half[axis])
      return false;
  }
  const auto is_in_box = [&](Vec3 q) {
    return std::fabs(q.x) <= half.x && std::fabs(q.y) <= half.y && std::fabs(q.z) <= half.z;
  };
  if (is_in_box(v[0]) || is_in_box(v[1]) || is_in_box(v[2])) return true;
  const Vec3 edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const Vec3 n = cross(edges[0], edges[1]);
  if (std::fabs(dot(n, v[0])) > dot(abs(n), half)) return false;
  for (int e = 0; e < 3; ++e) {
    // The two corners of an edge project to one point; the third is the other.
    const Vec3 p = v[e], q = v[(e + 2) % 3], d = edges[e];
    const auto apart = [&](double at_p, double at_q, double reach) {
      return std::min(at_p, at_q) > reach || std::max(at_p, at_q) < -reach;
    };
    const Vec3 a = abs(d);
    if (apart(d.y * p.z - d.z * p.y, d.y * q.z - d.z * q.y, a.y * half.z + a.z * half.y) ||
        apart(d.z * p.x - d.x * p.z, d.z * q.x - d.x * q.z, a.z * half.x + a.x * half.z) ||
        apart(d.x * p.y - d.y * p.x, d.x * q.y - d.y * q.x, a.x * half.y + a.y * half.x))
      return false;
  }
  return true;
}

/// By how much the winding number grows on the way down through a triangle above p; 0 if the way up
/// from p does not meet it.
int Boundary::crosses_above(const Triangle& triangle, Vec3 p) const {
  int side = 0;
  for (size_t e = 0; e < 3; ++e) {
    const uint32_t i = triangle.corners[e], j = triangle.corners[(e + 1) % 3];
    // Both triangles at an edge ask the same question about it.
    const int s = i < j ? side_of(points_[i], points_[j], p) : -side_of(points_[j], points_[i], p);
    if (s == 0 || (e > 0 && s != side)) return 0;
    side = s;
  }
  const Vec3 a = points_[triangle.corners[0]], b = points_[triangle.corners[1]],
             c = points_[triangle.corners[2]];
  if (std::min(a.z, std::min(b.z, c.z)) <= p.z) {
    if (std::max(a.z, std::max(b.z, c.z)) < p.z) return 0;
    // Seen from above the triangle runs counter-clockwise if side is 1: its normal points up.
    const Vec3 n = cross(b - a, c - a);
    if (dot(n, p - a) * side >= 0) return 0;
  }
  return side;
}

int Boundary::winding(Vec3 p) const {
  int sum = 0;
  const auto is_beside = [&](const Node& node) {
    return p.x < double(node.lo[0]) || p.x > double(node.hi[0]) || p.y < double(node.lo[1]) ||
           p.y > double(node.hi[1]) || p.z > double(node.hi[2]);
  };
  visit_leaves(is_beside, [&](uint32_t i) {
    const Column& c = columns_[i];
    if (!(p.x < double(c.lo_x) || p.x > double(c.hi_x) || p.y < double(c.lo_y) ||
          p.y > double(c.hi_y) || p.z > double(c.top)))
      sum += crosses_above(triangles_[i], p);
    return true;
  });
  return sum;
}

}  // namespace whittle

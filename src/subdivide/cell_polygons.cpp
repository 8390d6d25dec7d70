#include "subdivide/cell_polygons.h"

#include <algorithm>
#include <array>

namespace whittle {

void CellPolygons::measure(const Scene& scene, const Boundary& boundary,
                           const Boundary::Triangle& triangle, const CellBox& cell) {
  const HalfSpace& h = scene.half_spaces[scene.faces[triangle.face].literal >> 1];
  const auto distance = [&](Vec3 p) { return std::fabs(2 * dot(h.f.b, p - h.center)); };
  double off = 0;
  bool is_within = true;
  for (const uint32_t corner : triangle.corners) {
    off = std::max(off, distance(boundary.point(corner)));
    is_within = is_within && scene.region.contains(boundary.point(corner));
  }
  if (off <= slack) return;
  if (!is_within) {
    // The plane may be another one, that parts from the triangle where nobody looks.
    take(boundary, triangle, cell);
    off = 0;
    for (const Vec3& q : cut_) off = std::max(off, distance(cell.center + q));
  }
  slack = std::max(slack, off);
}

/// Puts what of a triangle is in the cell into `cut_`.
void CellPolygons::take(const Boundary& boundary, const Boundary::Triangle& triangle,
                        const CellBox& cell) {
  cut_.clear();
  for (const uint32_t corner : triangle.corners)
    cut_.push_back(boundary.point(corner) - cell.center);
  clip_to_box(cut_, cell.half);
}

void CellPolygons::add(const Scene& scene, const Boundary& boundary,
                       const Boundary::Triangle& triangle, const CellBox& cell,
                       const CellBox& larger) {
  // What does not cross the cell parts nothing in it.
  const Literal literal = scene.faces[triangle.face].literal;
  if (classify(scene.half_spaces[literal >> 1], larger) != Side::kCrosses) return;
  const Vec3 a = boundary.point(triangle.corners[0]);
  const Vec3 normal =
      cross(boundary.point(triangle.corners[1]) - a, boundary.point(triangle.corners[2]) - a);
  // Not by what of it is in the cell: a strip along the cell's side says where a wall there ends.
  if (!(width_of(std::array{a, boundary.point(triangle.corners[1]),
                            boundary.point(triangle.corners[2])}) > 4 * slack))
    return;
  take(boundary, triangle, larger);
  if (cut_.size() < 3) return;
  const uint32_t plane = plane_of(scene, triangle.face, cell);
  const int outward = dot(normal, planes[plane].n) < 0 ? -1 : 1;
  polygons.push_back({uint32_t(corners.size()), uint32_t(cut_.size()), plane, outward});
  corners.insert(corners.end(), cut_.begin(), cut_.end());
}

/// The number of the plane of `cut_`, a part of a face. Planes that cannot be told apart on it are
/// one.
uint32_t CellPolygons::plane_of(const Scene& scene, uint32_t face, const CellBox& cell) {
  const uint32_t number = scene.faces[face].literal >> 1;
  const HalfSpace& h = scene.half_spaces[number];
  const Vec3 n = h.f.b * 2.0;
  for (uint32_t i = 0; i < planes.size(); ++i) {
    if (planes[i].half_space == number) return i;
    const auto is_on = [&](Vec3 q) { return std::fabs(planes[i].at(q)) <= 2 * slack; };
    if (std::fabs(dot(n, planes[i].n)) > 0.9 && std::ranges::all_of(cut_, is_on)) {
      has_merged_ = true;
      return i;
    }
  }
  planes.push_back({n, dot(n, cell.center - h.center) + h.f.c, number, face, classify(h, cell)});
  return uint32_t(planes.size() - 1);
}

void CellPolygons::split(const Polygon& polygon, uint32_t plane, Polygon& front, Polygon& back) {
  const Plane& by = planes[plane];
  front = back = polygon;
  const auto half = [&](Polygon& part, double sign) {
    part.first = uint32_t(corners.size());
    for (uint32_t k = 0; k < polygon.count; ++k) {
      const Vec3 p = corners[polygon.first + k],
                 q = corners[polygon.first + (k + 1) % polygon.count];
      const double at_p = sign * by.at(p), at_q = sign * by.at(q);
      if (at_p >= 0) corners.push_back(p);
      if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
        corners.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    part.count = uint32_t(corners.size()) - part.first;
  };
  half(front, 1);
  half(back, -1);
}

/// About the thickness of a thin polygon: twice its area over its circumference.
double CellPolygons::width_of(std::span<const Vec3> polygon) {
  Vec3 area;
  double around = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k] - polygon[0],
               b = polygon[k + 1 < polygon.size() ? k + 1 : 0] - polygon[0];
    area += cross(a, b);
    around += length(b - a);
  }
  return around > 0 ? length(area) / around : 0;
}

double depth_in(std::span<const Vec3> polygon, Vec3 normal, double slack, Vec3 p) {
  double depth = kInfinity;
  bool has_short = false;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double l = length(b - a);
    if (l > slack)
      depth = std::min(depth, dot(cross(b - a, p - a), normal) / l);
    else
      has_short = true;
  }
  if (!has_short) return depth;
  // Without some of its edges it may have no end. The point may be off its plane by two slacks.
  Box box;
  for (const Vec3& corner : polygon) box.include(corner);
  const double beyond = std::max(max_component(box.lo - p), max_component(p - box.hi)) - 2 * slack;
  return beyond > 0 ? std::min(depth, -beyond) : depth;
}

}  // namespace whittle

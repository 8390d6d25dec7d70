// The triangles of a boundary as far as they are in a cell: convex polygons, and the planes that
// they lie on.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lower/boundary.h"
#include "lower/clip_polygon.h"
#include "lower/scene.h"
#include "subdivide/classify.h"

namespace whittle {

/// Points are relative to the cell's middle.
struct CellPolygons {
  /// Inside the half-space where n.q + value <= 0; n is a unit vector.
  struct Plane {
    Vec3 n;
    double value;
    uint32_t half_space;  ///< into Scene::half_spaces
    uint32_t face;        ///< into Scene::faces: the first one that lies on it
    Side cell;            ///< where the cell is, without what is beside it
    double at(Vec3 q) const { return dot(n, q) + value; }
  };
  struct Polygon {
    uint32_t first, count;  ///< into corners
    uint32_t plane;
    int outward;  ///< 1: the body is behind its plane; -1: in front of it
  };

  /// In the cell no triangle is farther than this from its plane. A polygon thinner than that says
  /// nothing about sides.
  double slack = 0;
  std::vector<Plane> planes;
  std::vector<Vec3> corners;
  std::vector<Polygon> polygons;

  /// Takes what is in the cell, or so near to it that planes of faces which are moved a little
  /// could be: of a wall in the cell's side, say, also where it ends. Of those triangles of the
  /// boundary for which `reaching` calls its argument, a function of an index into triangles().
  template <class Reaching>
  void collect(const Scene& scene, const Boundary& boundary, const CellBox& cell,
               const Reaching& reaching);

  std::span<const Vec3> corners_of(const Polygon& polygon) const {
    return std::span(corners).subspan(polygon.first, polygon.count);
  }
  /// The two parts of a polygon that a plane cuts; corners on the plane go to both. Parts may have
  /// fewer than three corners.
  void split(const Polygon& polygon, uint32_t plane, Polygon& front, Polygon& back);
  /// Whether a polygon is so thin that it tells nothing.
  bool is_thin(const Polygon& polygon) const {
    return polygon.count < 3 || !(width_of(corners_of(polygon)) > 2 * slack);
  }

 private:
  void measure(const Scene& scene, const Boundary& boundary, const Boundary::Triangle& triangle,
               const CellBox& cell);
  void take(const Boundary& boundary, const Boundary::Triangle& triangle, const CellBox& cell);
  void add(const Scene& scene, const Boundary& boundary, const Boundary::Triangle& triangle,
           const CellBox& cell, const CellBox& larger);
  uint32_t plane_of(const Scene& scene, uint32_t face, const CellBox& cell);
  static double width_of(std::span<const Vec3> polygon);

  std::vector<uint32_t> reaching_;
  std::vector<Vec3> cut_;
  bool has_merged_ = false;  ///< planes that cannot be told apart on a polygon are one
};

template <class Reaching>
void CellPolygons::collect(const Scene& scene, const Boundary& boundary, const CellBox& cell,
                           const Reaching& reaching) {
  slack = boundary.rounding();
  planes.clear();
  corners.clear();
  polygons.clear();
  reaching_.clear();
  reaching([this](uint32_t i) {
    reaching_.push_back(i);
    return true;
  });
  // Of the whole boundary the slack may be much more, and here it would hide what is small.
  for (const uint32_t i : reaching_) measure(scene, boundary, boundary.triangles()[i], cell);
  CellBox larger = cell;
  larger.half += Vec3{1, 1, 1} * (2 * slack);
  has_merged_ = false;
  for (const uint32_t i : reaching_) add(scene, boundary, boundary.triangles()[i], cell, larger);
  // What met the one plane, at an edge, may be as far beyond the other.
  if (has_merged_) slack *= 2;
}

/// How far a point in the plane of a convex polygon is inside of it. Outside: less than none, and
/// no more than how far it is from the polygon, negated. Edges of no more than the slack have no
/// direction that could be trusted.
double depth_in(std::span<const Vec3> polygon, Vec3 normal, double slack, Vec3 p);

}  // namespace whittle

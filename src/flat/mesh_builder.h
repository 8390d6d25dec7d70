// Puts a closed mesh together from facets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "shape/triangle_mesh.h"

namespace whittle {

class MeshBuilder {
 public:
  /// Points with equal coordinates are one.
  uint32_t point(Vec3 p);

  /// Equal planes are one.
  uint32_t facet(const Plane& plane);
  /// The plane of a triangle, outward if it runs counter-clockwise.
  uint32_t facet_of(uint32_t a, uint32_t b, uint32_t c);

  /// Left out if two corners are one point: then its edges cancel one another.
  void triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t facet);

  Vec3 operator[](uint32_t point) const { return mesh_.points[point]; }

  /// With its rise. Empty if something in it is not finite.
  TriangleMesh finish() &&;

 private:
  struct Hash {
    size_t operator()(const Vec3& p) const;
    size_t operator()(const Plane& plane) const;
  };
  struct Equal {
    bool operator()(const Plane& a, const Plane& b) const { return a.n == b.n && a.d == b.d; }
  };

  TriangleMesh mesh_;
  std::unordered_map<Vec3, uint32_t, Hash> points_;
  std::unordered_map<Plane, uint32_t, Hash, Equal> facets_;
};

}  // namespace whittle

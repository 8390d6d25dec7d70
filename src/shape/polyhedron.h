// A convex polyhedron.
#pragma once

#include "shape/complete_shape.h"

namespace whittle {

/// Empty planes mean an empty solid; build_planes() finds them.
struct Polyhedron {
  std::vector<Vec3> points;
  std::vector<std::vector<uint32_t>> faces;  ///< vertex loops, clockwise seen from outside
  std::vector<Plane> planes;                 ///< outward
  double rise = 0;  ///< how far below its plane a corner of a facet may be; slivers apart

  static constexpr std::string_view kName = "polyhedron";
  static constexpr bool kIsExact = false;
  bool is_empty() const { return planes.empty(); }
  uint64_t facet_count() const { return faces.size(); }
  std::nullopt_t wall() const { return std::nullopt; }
  std::vector<Plane> facet_planes() const { return planes; }
  size_t plane_count() const { return planes.size(); }
  std::vector<Vec3> outline() const;
  std::vector<Box> facet_boxes() const;
  const TriangleMesh* boundary() const { return nullptr; }
  Box box(const Affine& map) const;
  Box finite_box(const Affine& map) const { return transform(map, box({})); }
  Extent extent(std::span<const Vec3> outline, std::span<const Plane> planes_at_hand,
                const Affine& map) const {
    return flat_extent(outline, planes_at_hand, map);
  }
};

}  // namespace whittle

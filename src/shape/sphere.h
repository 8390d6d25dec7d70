// A ball about the origin.
#pragma once

#include "shape/complete_shape.h"

namespace whittle {

struct Sphere {
  double r = 1;
  int facets = 0;  ///< 0: the true sphere; n >= 3: OpenSCAD's polyhedron of n meridians

  static constexpr std::string_view kName = "sphere";
  static constexpr bool kIsExact = true;
  bool is_empty() const;
  uint64_t facet_count() const;
  double widest_radius() const { return r; }
  std::optional<Wall> wall() const;
  std::vector<Plane> facet_planes() const;
  size_t plane_count() const;
  std::vector<Vec3> outline() const;
  std::vector<Box> facet_boxes() const;
  const TriangleMesh* boundary() const { return nullptr; }
  Box box(const Affine& map) const;
  Box finite_box(const Affine& map) const;
  Extent extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                const Affine& map) const;
};

}  // namespace whittle

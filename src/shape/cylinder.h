// A cylinder, cone or frustum about the z axis.
#pragma once

#include "shape/complete_shape.h"

namespace whittle {

/// The frustum between z = 0 and z = h (centred: -h/2 and h/2), radius r1 below and r2 above.
struct Cylinder {
  double h = 1, r1 = 1, r2 = 1;
  bool center = false;
  int facets = 0;  ///< 0: the true curve; n >= 3: a prism or pyramid of n sides

  static constexpr std::string_view kName = "cylinder";
  static constexpr bool kIsExact = true;
  bool is_empty() const;
  uint64_t facet_count() const;
  double widest_radius() const;
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

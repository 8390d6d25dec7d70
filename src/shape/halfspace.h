// What lies on one side of a plane.
#pragma once

#include "shape/complete_shape.h"

namespace whittle {

/// The points p with n.p <= d; n need not be unit. whittle's own extension of the dialect.
struct Halfspace {
  Vec3 n{0, 0, 1};
  double d = 0;

  static constexpr std::string_view kName = "halfspace";
  static constexpr bool kIsExact = false;
  bool is_empty() const;
  uint64_t facet_count() const { return 0; }
  std::nullopt_t wall() const { return std::nullopt; }
  std::vector<Plane> facet_planes() const;
  size_t plane_count() const { return 1; }
  std::vector<Vec3> outline() const { return {}; }
  std::vector<Box> facet_boxes() const { return {Box::everything()}; }
  const TriangleMesh* boundary() const { return nullptr; }
  Box box(const Affine& map) const;
  Box finite_box(const Affine& map) const;
  Extent extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                const Affine& map) const {
    return flat_extent(outline, planes, map);
  }
};

}  // namespace whittle

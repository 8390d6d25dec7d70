// A box along the axes.
#pragma once

#include "shape/complete_shape.h"

namespace whittle {

struct Cube {
  Vec3 size{1, 1, 1};
  bool center = false;  ///< true: centred on the origin; false: lowest corner at the origin

  static constexpr std::string_view kName = "cube";
  static constexpr bool kIsExact = true;
  bool is_empty() const;
  uint64_t facet_count() const { return 0; }
  std::nullopt_t wall() const { return std::nullopt; }
  std::vector<Plane> facet_planes() const;
  size_t plane_count() const { return 6; }
  std::vector<Vec3> outline() const;
  std::vector<Box> facet_boxes() const;
  const TriangleMesh* boundary() const { return nullptr; }
  Box box(const Affine& map) const;
  Box finite_box(const Affine& map) const { return box(map); }
  Extent extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                const Affine& map) const {
    return flat_extent(outline, planes, map);
  }
};

}  // namespace whittle

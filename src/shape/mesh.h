// Any solid with flat faces.
#pragma once

#include <memory>

#include "shape/complete_shape.h"

namespace whittle {

/// Without a surface it is empty. Copies share the surface.
struct Mesh {
  std::shared_ptr<const TriangleMesh> surface;

  static constexpr std::string_view kName = "mesh";
  static constexpr bool kIsExact = false;
  bool is_empty() const;
  uint64_t facet_count() const;
  std::nullopt_t wall() const { return std::nullopt; }
  std::vector<Plane> facet_planes() const;
  size_t plane_count() const;
  std::vector<Vec3> outline() const;
  std::vector<Box> facet_boxes() const;
  const TriangleMesh* boundary() const { return surface.get(); }
  Box box(const Affine& map) const;
  Box finite_box(const Affine& map) const;
  /// Its width is twice its volume over its area: the thickness of what is thin everywhere.
  Extent extent(std::span<const Vec3> outline, std::span<const Plane> planes,
                const Affine& map) const;
};

}  // namespace whittle

// What facets stand for: the normals of the curves that they were made of.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "boundary/solid_mesh.h"
#include "lower/scene.h"
#include "model/model.h"

namespace whittle {

/// Cylinders and spheres with more sides than this are meant to be round.
inline constexpr int kMostCorneredSides = 12;

class TrueNormals {
 public:
  /// `model` as it is written, `facetted` the same with facets and `scene` what that became.
  TrueNormals(const Model& model, const Model& facetted, const Scene& scene);

  /// The unit outward normal of the surface that a face is a part or a facet of, near a point.
  Vec3 at(const SolidMesh::Face& face, Vec3 point) const;

  /// The body that a face belongs to if that body is made of many flat or curved parts, so that
  /// nobody knows which of its edges stand for a curve; else 0.
  uint32_t body(const SolidMesh::Face& face) const { return bodies_[face.half_space]; }

  /// Whether it may be a facet that only drawing has made.
  bool may_be_made(const SolidMesh::Face& face) const { return has_made_[face.half_space]; }

 private:
  struct Wall {
    HalfSpace surface;  ///< local coordinates
    double slack;       ///< points of its facets are no farther from it
  };
  Vec3 origin_;
  std::vector<Wall> walls_;
  // By half-space of the scene. Facets of several walls may lie in one plane.
  std::vector<uint32_t> bodies_;
  std::vector<bool> has_made_;
  std::vector<uint32_t> firsts_, members_;  ///< into members_, and these into walls_
};

}  // namespace whittle

// The surfaces of a model by name: which faces of which primitives lie on the same one.
//
// The rule is that of docs/conventions.md, Coincidence, carried out by comparing every face with
// every surface before it. A face that lies on a surface that another primitive had first is looked
// at as that very surface, in that primitive's coordinates; so what coincides is crossed by a ray
// at the same number, and nothing need be compared along the ray.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instances.h"

namespace whittle {

/// In the coordinates of the primitive that had it first.
struct Surface {
  enum class Kind : uint8_t {
    kPlane,   ///< n.p <= d is inside
    kSphere,  ///< about the origin
    kCone,    ///< x^2 + y^2 <= r(z)^2 with r(z) = radius + slope (z - z0), where r(z) >= 0
  };
  Kind kind = Kind::kPlane;
  uint32_t frame = 0;  ///< into Surfaces::frames
  Plane plane;
  double radius = 0;
  double slope = 0, z0 = 0, z1 = 0;  ///< z0 to z1: the part on the primitive itself
};

/// A face of a primitive.
struct SurfaceFace {
  uint32_t surface = 0;
  bool other_side = false;  ///< the primitive is beyond the plane; or on the cone's other nappe
};

struct Surfaces {
  struct Frame {
    Affine object_from_world;
    Vec3 anchor;  ///< where the primitive is looked at, own coordinates
  };
  std::vector<Frame> frames;
  std::vector<Surface> all;
  std::vector<SurfaceFace> faces;      ///< solid by solid, in file order
  std::vector<uint32_t> faces_before;  ///< solid i has the faces from [i] to [i + 1]

  size_t solid_count() const { return faces_before.size() - 1; }
  std::span<const SurfaceFace> faces_of(size_t solid) const {
    return std::span(faces).subspan(faces_before[solid],
                                    faces_before[solid + 1] - faces_before[solid]);
  }
};

/// The surfaces of those instances that are not empty, each of which is a solid. Takes the square
/// of the number of faces.
Surfaces name_surfaces(const Model& model, std::span<const Instance> instances);

}  // namespace whittle

// The lowered model: numbered half-spaces, and one formula over them.
//
// All coordinates are local: world minus `origin`, the middle of the region. So a model far from
// the world's origin loses no digits. For the same reason each half-space has a centre of its own,
// near the primitive it came from.
#pragma once

#include <cstdint>
#include <vector>

#include "base/affine.h"
#include "base/box.h"
#include "base/uninitialized.h"
#include "kernels/kernels.h"
#include "lower/boundary.h"
#include "lower/formula.h"

namespace whittle {

enum class SurfaceKind : uint8_t {
  kPlane,    ///< no second degree
  kSphere,   ///< f.diag all equal, f.off and f.b zero
  kQuadric,  ///< any other
};

/// {p : f(p - center) <= 0}, scaled so that |f| is about the distance near the surface (the
/// gradient there is at most 1, and 1 where the surface is steepest). Planes have no second degree.
struct HalfSpace {
  Vec3 center;
  Kernels<double>::Quadric f;
  SurfaceKind kind = SurfaceKind::kQuadric;
  uint32_t tip = kNoTip;  ///< of a cone that comes near it: into Scene::tips

  static constexpr uint32_t kNoTip = UINT32_MAX;
  bool has_tip() const { return tip != kNoTip; }
  bool is_plane() const { return kind == SurfaceKind::kPlane; }
};

/// One face of a primitive: which half-space, and whose.
struct Face {
  Literal literal = 0;
  uint32_t unit = 0;
};

/// A primitive: the conjunction of its faces, or what is inside of a boundary.
struct Unit {
  uint32_t id = 0;          ///< of the primitive statement
  uint32_t first_face = 0;  ///< into Scene::faces
  uint32_t face_count = 0;
  Box outer;          ///< holds the primitive; everything if it is unbounded
  Vec3 inner_center;  ///< a ball that the primitive holds; only where there are many faces
  double inner_radius = 0;
  uint32_t first_box = kNoBoxes;  ///< into Scene::face_boxes, one a face; only where there are many
  uint32_t box_frame = 0;         ///< into Scene::box_frames, if it has boxes

  uint32_t boundary = kNoBoundary;  ///< into Scene::boundaries; then the faces are its planes

  bool inward = false;  ///< it is taken away from the body it is a part of

  static constexpr uint32_t kNoBoxes = UINT32_MAX, kNoBoundary = UINT32_MAX;
  bool is_conjunction() const { return boundary == kNoBoundary; }
};

struct Scene {
  Vec3 origin;           ///< world = local + origin
  Box region;            ///< local; the solid is looked at in here; empty if the solid is
  bool bounded = true;   ///< false: the solid may reach beyond the region
  double tolerance = 0;  ///< surfaces this close across are one (docs/conventions.md)
  UninitializedVector<HalfSpace> half_spaces;
  std::vector<Vec3> tips;  ///< of cones; about its tip a cone's f has the second degree alone
  UninitializedVector<Face> faces;
  UninitializedVector<Unit> units;
  /// Where a facet is, in its primitive's own axes, along which long facets mostly lie. Grown by
  /// more than rounding and merging can have moved it.
  UninitializedVector<Box> face_boxes;
  std::vector<Affine> box_frames;  ///< own from local
  std::vector<Boundary> boundaries;
  Formula formula;
};

}  // namespace whittle

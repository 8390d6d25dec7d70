#include "model/instances.h"
#include "subdivide/subdivide.h"
#include "trace/cpu/lanes.h"

namespace whittle {
namespace {

/// Curved surfaces whose radius is below this share of the region's longest edge get the arithmetic
/// for small ones. Without it a surface is blurred by its share's inverse times what rounding does
/// to the region.
constexpr double kSmall = 1.0 / 64;

/// Half-spaces that one thread prepares in one go.
constexpr size_t kEach = 4096;

LaneHalfSpace in_lanes(const Scene& scene, const HalfSpace& h, double edge) {
  LaneHalfSpace result{h.center, h.f.b, h.f.c, AlongKind::kPlane};
  if (h.is_plane()) return result;
  // As f is scaled, 2 |c| is the radius, or the least one.
  const bool is_small = 2 * std::fabs(h.f.c) < kSmall * edge;
  if (h.kind == SurfaceKind::kSphere) {
    result.kind = is_small ? AlongKind::kSmallSphere : AlongKind::kSphere;
    result.v = h.f.diag;
  } else if (h.has_tip()) {
    result.kind = is_small ? AlongKind::kSmallCone : AlongKind::kCone;
    result.center = scene.tips[h.tip];
  } else if (is_small) {
    result.kind = AlongKind::kSmallQuadric;
  } else if (h.f.off == Vec3{} && h.f.b == Vec3{}) {
    result.kind = AlongKind::kDiagonal;
    result.v = h.f.diag;
  } else {
    result.kind = AlongKind::kQuadric;
  }
  return result;
}

}  // namespace

LaneScene::LaneScene(const Scene& scene_, const CellTree& tree_, const Workers* workers)
    : scene(scene_),
      tree(tree_),
      edge(max_component(scene.region.size())),
      together(whittle::together({scene.region.lo + scene.origin, scene.region.hi + scene.origin})),
      half_spaces(scene.half_spaces.size()) {
  const double half_margin = 0.5 * kCellMargin * edge;
  const Vec3 grown = {half_margin, half_margin, half_margin};
  clip = {tree.region.lo - grown, tree.region.hi + grown};
  for_parts(workers, half_spaces.size(), kEach, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i)
      half_spaces[i] = in_lanes(scene, scene.half_spaces[i], edge);
  });
}

}  // namespace whittle

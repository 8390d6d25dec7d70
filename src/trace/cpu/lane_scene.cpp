#include "lower/along_kind.h"
#include "model/instances.h"
#include "subdivide/subdivide.h"
#include "trace/cpu/lanes.h"

namespace whittle {
namespace {

/// Half-spaces that one thread prepares in one go.
constexpr size_t kEach = 4096;

LaneHalfSpace in_lanes(const Scene& scene, const HalfSpace& h, double edge) {
  LaneHalfSpace result{h.center, h.f.b, h.f.c, along_kind(h, edge)};
  if (h.kind == SurfaceKind::kSphere || result.kind == AlongKind::kDiagonal) result.v = h.f.diag;
  if (h.has_tip()) result.center = scene.tips[h.tip];
  return result;
}

}  // namespace

LaneScene::LaneScene(const Scene& scene_, const CellTree& tree_, const Workers* workers)
    : scene(scene_),
      tree(tree_),
      edge(max_component(scene.region.size())),
      ray_tolerance(
          whittle::ray_tolerance({scene.region.lo + scene.origin, scene.region.hi + scene.origin})),
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

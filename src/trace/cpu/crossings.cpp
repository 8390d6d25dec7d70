#include "trace/cpu/crossings.h"

#include <cmath>

namespace whittle {
namespace {

using K = Kernels<double>;

/// Unit outward normal of the half-space at a point of its surface.
Vec3 normal_at(const LaneScene& scene, uint32_t half_space, Vec3 point) {
  const LaneHalfSpace& h = scene.half_spaces[half_space];
  if (h.kind == AlongKind::kPlane) return normalize(h.v);
  K::Quadric f = scene.scene.half_spaces[half_space].f;
  // About its tip a cone has the second degree alone.
  if (is_cone(h.kind)) f.b = {};
  return normalize(K::quadric_half_gradient(f, point - h.center));
}

}  // namespace

void add_crossings(const LaneScene& scene, const LocalRay& ray, double shift,
                   std::span<const LaneChange> changes, RayCrossings& found) {
  const size_t first = found.all.size();
  for (const LaneChange& at : changes) {
    const Change& change = at.change;
    SurfaceCrossing crossing{change.t + shift, change.id, change.enters, {}};
    const bool has_before = found.all.size() > first;
    // Crossings that coincide lie in two cells only if rounding parts them.
    if (has_before && found.all.back().enters != change.enters &&
        crossing.distance <= found.all.back().distance + scene.ray_tolerance) {
      found.all.pop_back();
      continue;
    }
    if (change.half_space == LaneChange::kNoHalfSpace) {
      // The surface that was crossed before lies there too, within what cells may disagree by.
      if (!has_before) continue;
      crossing.id = found.all.back().id;
      crossing.normal = change.enters ? -ray.direction : ray.direction;
    } else {
      const Vec3 n = normal_at(scene, change.half_space, ray.origin + ray.direction * change.t);
      crossing.normal = change.turned ? -n : n;
    }
    found.all.push_back(crossing);
  }
  found.ends.push_back(found.all.size());
}

}  // namespace whittle

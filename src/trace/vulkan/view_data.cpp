#include "trace/vulkan/view_data.h"

#include "kernels/constants.h"
#include "model/instances.h"
#include "trace/vulkan/words.h"

namespace whittle {
namespace {

/// Further than any change.
constexpr double kEverywhere = 1e37;

}  // namespace

Vec3 local_eye(const Scene& scene, const Camera& camera) {
  return camera.eye - scene.origin;
}

double reference_ahead(const Box& region, const Camera& camera, Vec3 eye) {
  if (camera.orthographic) return dot(region.center() - eye, camera.forward);
  return length(max(max(region.lo - eye, eye - region.hi), Vec3{}));
}

ViewData make_view_data(const Scene& scene, double cell_margin, const Camera& camera,
                        const PixelRect& tile, bool doubles, bool probes, double margin) {
  ViewData data;
  const double edge = max_component(scene.region.size());
  const Vec3 eye = local_eye(scene, camera);
  const double ahead = doubles ? 0 : reference_ahead(scene.region, camera, eye);
  const auto set_number = [&](uint32_t at, double number) {
    const std::array<uint32_t, 2> words = words_of(number, doubles);
    data.numbers[2 * at] = words[0];
    data.numbers[2 * at + 1] = words[1];
  };
  const auto set_vector = [&](uint32_t at, Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) set_number(at + uint32_t(axis), v[axis]);
  };
  set_vector(shader::kViewAxis, doubles ? eye : Vec3{});
  set_vector(shader::kViewRight, camera.right);
  set_vector(shader::kViewUp, camera.up);
  set_vector(shader::kViewForward, camera.forward);
  set_number(shader::kViewScale, camera.units_per_pixel());
  set_number(shader::kViewHalfWidth, 0.5 * camera.width);
  set_number(shader::kViewHalfHeight, 0.5 * camera.height);
  set_number(shader::kViewStart, camera.orthographic ? -camera.ortho_reach : 0);
  if (doubles) {
    const Box world{scene.region.lo + scene.origin, scene.region.hi + scene.origin};
    set_number(shader::kViewAtEye, kAtEye * edge);
    set_number(shader::kViewOnSurface, kOnSurface * edge);
    set_number(shader::kViewAhead, kAhead * edge);
    set_number(shader::kViewRayTolerance, ray_tolerance(world));
  } else {
    set_number(shader::kViewAxisAhead, ahead);
    set_number(shader::kViewGrown, 0.5 * cell_margin);
    set_number(shader::kViewBeyond, scene.bounded ? kEverywhere : 0);
    set_number(shader::kViewAtSurface, 4 * kOnSurface * edge);
    set_vector(shader::kViewReference, eye + camera.forward * ahead);
  }
  data.tile_origin = {tile.x0, tile.y0};
  data.tile_size = {tile.width(), tile.height()};
  data.orthographic = camera.orthographic;
  data.probes = probes;
  data.margin = float(margin);
  return data;
}

}  // namespace whittle

#include "trace/vulkan/view_data.h"

#include <initializer_list>

#include "model/instances.h"
#include "trace/vulkan/words.h"

namespace whittle {
namespace {

/// An eye this close to a surface stands on it, this close to the eye a ray still does, and this
/// far ahead it looks where it goes; shares of the region's longest edge, above what rounding does.
/// With floats such places are in doubt.
constexpr double kOnSurface = 2e-14, kAtEye = 1e-13, kAhead = 1e-9;

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
  // In the order of shaders/view.glsl.
  size_t count = 0;
  const auto add = [&](std::initializer_list<double> numbers) {
    for (const double number : numbers)
      for (const uint32_t word : words_of(number, doubles)) data.numbers[count++] = word;
  };
  const auto add_vector = [&](Vec3 v) { add({v.x, v.y, v.z}); };
  add_vector(doubles ? eye : Vec3{});
  add_vector(camera.right);
  add_vector(camera.up);
  add_vector(camera.forward);
  add({camera.units_per_pixel(), 0.5 * camera.width, 0.5 * camera.height,
       camera.orthographic ? -camera.ortho_reach : 0});
  if (doubles) {
    add({kAtEye * edge, kOnSurface * edge, kAhead * edge,
         together({scene.region.lo + scene.origin, scene.region.hi + scene.origin})});
  } else {
    add({ahead, 0.5 * cell_margin, scene.bounded ? kEverywhere : 0, 4 * kOnSurface * edge});
    add_vector(eye + camera.forward * ahead);
  }
  data.tile_origin = {tile.x0, tile.y0};
  data.tile_size = {tile.width(), tile.height()};
  data.orthographic = camera.orthographic;
  data.probes = probes;
  data.margin = float(margin);
  return data;
}

}  // namespace whittle

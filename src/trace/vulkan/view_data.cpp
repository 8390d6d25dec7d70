#include "trace/vulkan/view_data.h"

#include <bit>

#include "model/instances.h"

namespace whittle {
namespace {

/// An eye this close to a surface stands on it, this close to the eye a ray still does, and this
/// far ahead it looks where it goes; shares of the region's longest edge, above what rounding does.
struct EyeRules {
  double on_surface, at_eye, ahead;
};
constexpr EyeRules kInDoubles{2e-14, 1e-13, 1e-9};
constexpr EyeRules kInFloats{1e-6, 5e-6, 1e-4};

}  // namespace

Vec3 local_eye(const Scene& scene, const Camera& camera) {
  return camera.eye - scene.origin;
}

ViewData make_view_data(const Scene& scene, const Camera& camera, const PixelRect& tile,
                        bool doubles, bool probes, double margin) {
  ViewData data;
  const EyeRules& rules = doubles ? kInDoubles : kInFloats;
  const double edge = max_component(scene.region.size());
  const Vec3 eye = local_eye(scene, camera);
  const double together_here =
      together({scene.region.lo + scene.origin, scene.region.hi + scene.origin});
  // In the order of shaders/view.glsl.
  const double numbers[] = {eye.x,
                            eye.y,
                            eye.z,
                            camera.right.x,
                            camera.right.y,
                            camera.right.z,
                            camera.up.x,
                            camera.up.y,
                            camera.up.z,
                            camera.forward.x,
                            camera.forward.y,
                            camera.forward.z,
                            camera.units_per_pixel(),
                            0.5 * camera.width,
                            0.5 * camera.height,
                            camera.orthographic ? -camera.ortho_reach : 0,
                            rules.at_eye * edge,
                            rules.on_surface * edge,
                            rules.ahead * edge,
                            doubles ? together_here : 0};
  static_assert(2 * std::size(numbers) == std::tuple_size_v<decltype(data.numbers)>);
  for (size_t i = 0; i < std::size(numbers); ++i) {
    if (doubles) {
      const auto bits = std::bit_cast<uint64_t>(numbers[i]);
      data.numbers[2 * i] = uint32_t(bits);
      data.numbers[2 * i + 1] = uint32_t(bits >> 32);
    } else {
      data.numbers[2 * i] = std::bit_cast<uint32_t>(float(numbers[i]));
    }
  }
  data.tile_origin = {tile.x0, tile.y0};
  data.tile_size = {tile.width(), tile.height()};
  data.orthographic = camera.orthographic;
  data.probes = probes;
  data.margin = float(margin);
  return data;
}

}  // namespace whittle

#include "trace/closeness.h"

#include <algorithm>
#include <array>

namespace whittle {
namespace {

/// Rays along each side of the picture.
constexpr size_t kAcross = 8;

/// Rays that meet the edge, squared, seen from this far away along the camera's axis.
double rays_from(const Camera& camera, const Box& region, double distance) {
  const double pixel = camera.units_per_pixel() * (camera.orthographic ? 1 : distance);
  const double across = max_component(region.size()) / pixel;
  return across * across;
}

}  // namespace

double rays_at_most(const Camera& camera, const Box& region) {
  if (region.is_empty()) return 0;
  double nearest = kInfinity;
  for (int i = 0; i < 8; ++i)
    nearest = std::min(nearest, dot(region.corner(i) - camera.eye, camera.forward));
  return rays_from(camera, region, std::max(nearest, 0.0));
}

double rays_at_nearest_hit(Tracer& tracer, const Camera& camera, const Box& region) {
  std::array<PixelPosition, kAcross * kAcross> positions;
  std::array<Hit, positions.size()> hits;
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto share = [](size_t n) { return (float(n) + 0.5f) / float(kAcross); };
    positions[i] = {share(i % kAcross) * float(camera.width),
                    share(i / kAcross) * float(camera.height)};
  }
  tracer.probe(camera, positions, hits);
  const Hit nearest = *std::ranges::min_element(hits, {}, &Hit::distance);
  return nearest.hit() ? rays_from(camera, region, nearest.distance) : 0;
}

}  // namespace whittle

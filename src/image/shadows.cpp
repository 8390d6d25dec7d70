#include "image/shadows.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr size_t kTargetsPerTask = 4096;
/// Each batch of hits is looked at from every light; many at a time, for backends that draw.
constexpr size_t kShadowsPerBatch = size_t(1) << 20;

}  // namespace

Shadows::Shadows(Tracer& tracer, const Camera& camera, const ShadeSettings& settings,
                 const Workers& workers)
    : tracer_(tracer),
      camera_(camera),
      lights_(lights(camera, settings)),
      casters_(settings.casters),
      workers_(workers) {}

void Shadows::find(std::span<const Hit> hits, std::span<const PixelPosition> places,
                   std::vector<uint8_t>& shadows) {
  shadows.assign(hits.size(), 0);
  if (casters_.is_empty() || lights_.empty()) return;
  seen_.resize(hits.size());
  workers_.for_parts(hits.size(), kTargetsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      if (!hits[i].hit()) continue;
      const Ray ray = camera_.ray(double(places[i].x), double(places[i].y));
      const float way = hits[i].distance;
      const Vec3f n = hits[i].normal;
      const bool from_inside = dot(to_double(n), ray.direction) > 0;
      seen_[i] = {ray.origin + ray.direction * double(way), from_inside ? n * -1.0f : n,
                  std::fabs(way)};
    }
  });
  for (size_t k = 0; k < lights_.size(); ++k)
    find_light(lights_[k], uint8_t(1 << k), hits, shadows);
}

void Shadows::find_light(const Light& light, uint8_t bit, std::span<const Hit> hits,
                         std::vector<uint8_t>& shadows) {
  // What the eye sees, a light at the eye reaches.
  if (!light.is_direction && !camera_.orthographic && light.at == camera_.eye) return;
  targets_.clear();
  for (size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit()) continue;
    const Seen& seen = seen_[i];
    const Vec3 to_light = light.is_direction ? light.at : normalize(light.at - seen.point);
    const auto cosine = float(dot(to_double(seen.normal), to_light));
    if (cosine > 0) targets_.push_back({uint32_t(i), cosine});
  }
  rays_.resize(targets_.size());
  found_.resize(targets_.size());
  workers_.for_parts(targets_.size(), kTargetsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) rays_[i] = ray_to(seen_[targets_[i].hit].point, light);
  });
  tracer_.cast(rays_, found_);
  workers_.for_parts(targets_.size(), kTargetsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      if (!found_[i].hit()) continue;
      const Seen& seen = seen_[targets_[i].hit];
      const double way = dot(seen.point - rays_[i].origin, rays_[i].direction);
      const double slack = kShadowTolerance * (double(seen.way) + std::fabs(way)) *
                           (1 + 1 / double(targets_[i].cosine));
      if (double(found_[i].distance) < way - slack) shadows[targets_[i].hit] |= bit;
    }
  });
}

/// Parallel light comes from behind all that casts shadows; its way counts from the plane through
/// their middle.
Ray Shadows::ray_to(Vec3 point, const Light& light) const {
  if (!light.is_direction) return {light.at, normalize(point - light.at), 0};
  const Vec3 from = point + light.at * dot(casters_.center() - point, light.at);
  return {from, light.at * -1, -casters_.diagonal()};
}

std::vector<uint8_t> Shadows::of_frame(const Frame& frame) {
  std::vector<uint8_t> shadows, some;
  shadows.reserve(frame.hits.size());
  std::vector<PixelPosition> places;
  const size_t width = size_t(frame.width);
  const size_t rows = std::max<size_t>(1, kShadowsPerBatch / width);
  for (size_t y = 0; y < size_t(frame.height); y += rows) {
    const size_t last = std::min(y + rows, size_t(frame.height));
    places.clear();
    for (size_t row = y; row < last; ++row)
      for (size_t x = 0; x < width; ++x) places.push_back({float(x) + 0.5f, float(row) + 0.5f});
    find(std::span(frame.hits).subspan(y * width, places.size()), places, some);
    shadows.insert(shadows.end(), some.begin(), some.end());
  }
  return shadows;
}

void add_shadow_edges(const std::vector<uint8_t>& shadows, size_t width,
                      std::vector<uint8_t>& mask) {
  const size_t height = shadows.size() / width;
  const auto compare = [&](size_t a, size_t b) {
    if (shadows[a] != shadows[b]) mask[a] = mask[b] = 1;
  };
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      const size_t at = y * width + x;
      if (x + 1 < width) compare(at, at + 1);
      if (y + 1 == height) continue;
      compare(at, at + width);
      if (x > 0) compare(at, at + width - 1);
      if (x + 1 < width) compare(at, at + width + 1);
    }
  }
}

}  // namespace whittle

#include "image/shadows.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr size_t kTargetsPerTask = 4096;
/// A light near the points that it lights, or between them, looks six ways; else one. As the
/// tangent of the angle between the middle and the side of what it sees.
constexpr double kWidest = 2;
/// Pixels a side of the picture from a light. There is about one for each target, so that backends
/// that draw find a place for each in few drawings.
constexpr double kMostSide = 1 << 14;

/// The coordinates of a vector along another two and the direction they are square to.
struct Basis {
  Vec3 right, up, forward;

  explicit Basis(Vec3 along) : forward(along) {
    const Vec3 aside = std::fabs(along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    right = normalize(cross(along, aside));
    up = cross(right, along);
  }
  Vec3 of(Vec3 v) const { return {dot(v, right), dot(v, up), dot(v, forward)}; }
};

Vec3 to_double(Vec3f v) {
  return {double(v.x), double(v.y), double(v.z)};
}

/// Which of the six directions along the axes is nearest: 0 to 5.
int nearest_axis(Vec3 v) {
  const Vec3 size{std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (v[axis] < 0);
}

Vec3 along_axis(int number) {
  Vec3 v{};
  v[number / 2] = number % 2 == 0 ? 1 : -1;
  return v;
}

/// Whether all corners of a box lie within kWidest about a direction, seen from a point.
bool fits_one_view(const Box& box, Vec3 from, Vec3 forward) {
  const Basis basis(forward);
  for (int i = 0; i < 8; ++i) {
    const Vec3 v = basis.of(box.corner(i) - from);
    if (!(std::max(std::fabs(v.x), std::fabs(v.y)) <= kWidest * v.z)) return false;
  }
  return true;
}

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
  Box box;
  for (size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit()) continue;
    const Seen& seen = seen_[i];
    const Vec3 to_light = light.is_direction ? light.at : normalize(light.at - seen.point);
    const auto cosine = float(dot(to_double(seen.normal), to_light));
    if (!(cosine > 0)) continue;
    targets_.push_back({uint32_t(i), cosine});
    box.include(seen.point);
  }
  if (targets_.empty()) return;
  if (light.is_direction) return look_from(light, light.at * -1, targets_, bit, shadows);
  const Vec3 middle = box.center() - light.at;
  if (length(middle) > 0 && fits_one_view(box, light.at, normalize(middle)))
    return look_from(light, normalize(middle), targets_, bit, shadows);
  for (int axis = 0; axis < 6; ++axis) {
    group_.clear();
    std::ranges::copy_if(targets_, std::back_inserter(group_), [&](const Target& target) {
      return nearest_axis(seen_[target.hit].point - light.at) == axis;
    });
    if (!group_.empty()) look_from(light, along_axis(axis), group_, bit, shadows);
  }
}

void Shadows::look_from(const Light& light, Vec3 forward, std::span<const Target> targets,
                        uint8_t bit, std::vector<uint8_t>& shadows) {
  const Basis basis(forward);
  // Of parallel light only the direction counts: the eye's plane goes through the middle.
  const Vec3 from = light.is_direction ? casters_.center() : light.at;
  along_.resize(targets.size());
  workers_.for_parts(targets.size(), kTargetsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      along_[i] = basis.of(seen_[targets[i].hit].point - from);
      if (!light.is_direction) along_[i].x /= along_[i].z, along_[i].y /= along_[i].z;
    }
  });
  double half = 0;
  Box rect;
  for (const Vec3& v : along_) {
    half = std::max({half, std::fabs(v.x), std::fabs(v.y)});
    rect.include({v.x, v.y, 0});
  }
  const double area = std::max(rect.size().x, half * 1e-3) * std::max(rect.size().y, half * 1e-3);
  const double side = 2 * half / std::sqrt(area / double(targets.size()));

  Camera camera;
  camera.eye = from;
  camera.right = basis.right, camera.up = basis.up, camera.forward = forward;
  camera.orthographic = light.is_direction;
  camera.ortho_reach = light.is_direction ? casters_.diagonal() : 0;
  camera.half_height = half > 0 ? half : 1;
  camera.width = camera.height = half > 0 ? int(std::clamp(std::ceil(side), 1.0, kMostSide)) : 1;
  const double units = camera.units_per_pixel(), middle = 0.5 * camera.width;

  positions_.resize(targets.size());
  found_.assign(targets.size(), Hit{});
  for (size_t i = 0; i < targets.size(); ++i)
    positions_[i] = {float(middle + along_[i].x / units), float(middle - along_[i].y / units)};
  tracer_.probe(camera, positions_, found_);
  workers_.for_parts(targets.size(), kTargetsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      if (!found_[i].hit()) continue;
      const Seen& seen = seen_[targets[i].hit];
      const double way = light.is_direction ? along_[i].z : length(seen.point - from);
      const double slack = kShadowTolerance * (double(seen.way) + std::fabs(way)) *
                           (1 + 1 / double(targets[i].cosine));
      if (double(found_[i].distance) < way - slack) shadows[targets[i].hit] |= bit;
    }
  });
}

}  // namespace whittle

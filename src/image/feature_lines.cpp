#include "image/feature_lines.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr float kCreaseStrength = 0.8f;

Vec3f to_float(Vec3 v) {
  return {float(v.x), float(v.y), float(v.z)};
}

/// 0 up to `low`, 1 from `high` on.
float ramp(float v, float low, float high) {
  const float t = std::clamp((v - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

Spot::Spot(const Camera& camera, PixelPosition place, const Hit& hit)
    : id(hit.id), normal(hit.normal) {
  if (id == 0) return;
  const Ray ray = camera.ray(double(place.x), double(place.y));
  direction = to_float(ray.direction);
  point = to_float(ray.origin - camera.eye + ray.direction * double(hit.distance));
  pixel = float(camera.units_per_pixel()) * (camera.orthographic ? 1 : hit.distance);
}

float pixels_apart(const Spot& a, const Spot& b) {
  const Vec3f between = b.point - a.point;
  const auto off = [&](Vec3f normal, Vec3f direction) {
    constexpr float kGrazing = 1e-3f;
    return std::fabs(dot(normal, between)) / std::max(std::fabs(dot(normal, direction)), kGrazing);
  };
  const float apart = std::min(off(a.normal, b.direction), off(b.normal, a.direction));
  return apart / std::max(a.pixel, b.pixel);
}

float line_between(const Spot& a, const Spot& b) {
  if (a.id == 0 || b.id == 0) return a.id == b.id ? 0.0f : 1.0f;
  const bool is_one = a.id == b.id;
  // Facets of one primitive that stand for a curve differ by less than the faces of two do.
  const float bend = 1 - dot(a.normal, b.normal);
  const auto bend_of = [](double degrees) {
    return float(1 - std::cos(degrees * std::acos(-1.0) / 180));
  };
  static const float kOneLow = bend_of(18), kOneHigh = bend_of(36);
  static const float kTwoLow = bend_of(6), kTwoHigh = bend_of(20);
  const float crease = ramp(bend, is_one ? kOneLow : kTwoLow, is_one ? kOneHigh : kTwoHigh);
  const float apart = pixels_apart(a, b);
  const float step = is_one ? ramp(apart, 1.5f, 3) : ramp(apart, 0.75f, 2);
  return std::max(kCreaseStrength * crease, step);
}

}  // namespace whittle

#include "lines/projection.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// How far beside the frame lines are still drawn, so that their ends are not seen; pixels.
constexpr double kBesideFrame = 4;

/// Narrows from..to to where value(s) = at_a + (at_b - at_a) s is not negative. False: nowhere.
bool clip(double at_a, double at_b, double& from, double& to) {
  if (at_a < 0 && at_b < 0) return false;
  if (at_a >= 0 && at_b >= 0) return true;
  const double zero = at_a / (at_a - at_b);
  if (at_a < 0)
    from = std::max(from, zero);
  else
    to = std::min(to, zero);
  return from < to;
}

}  // namespace

Vec2 ViewProjection::place(Vec3 point, double depth) const {
  const Vec3 way = point - camera_.eye;
  const double x = dot(way, camera_.right), y = dot(way, camera_.up);
  if (camera_.orthographic) return {x * scale_, -y * scale_};
  const double unit = camera_.units_per_pixel() * depth;
  return {0.5 * camera_.width + x / unit, 0.5 * camera_.height - y / unit};
}

std::optional<DrawnLine> ViewProjection::draw(Vec3 from, Vec3 to) const {
  double depth_a = depth(from), depth_b = depth(to);
  if (camera_.orthographic)
    return DrawnLine{place(from, depth_a), place(to, depth_b), from, to, depth_a, depth_b, 0};

  double s0 = 0, s1 = 1;
  if (!clip(depth_a - nearest_, depth_b - nearest_, s0, s1)) return std::nullopt;
  const Vec3 a = from + (to - from) * s0, b = from + (to - from) * s1;
  depth_a = std::max(depth(a), nearest_), depth_b = std::max(depth(b), nearest_);
  DrawnLine line{place(a, depth_a), place(b, depth_b), a, b, 1 / depth_a, 1 / depth_b, 0};
  s0 = 0, s1 = 1;
  const double right = camera_.width + kBesideFrame, bottom = camera_.height + kBesideFrame;
  if (!clip(line.a.x + kBesideFrame, line.b.x + kBesideFrame, s0, s1) ||
      !clip(right - line.a.x, right - line.b.x, s0, s1) ||
      !clip(line.a.y + kBesideFrame, line.b.y + kBesideFrame, s0, s1) ||
      !clip(bottom - line.a.y, bottom - line.b.y, s0, s1))
    return std::nullopt;
  if (s0 == 0 && s1 == 1) return line;
  return DrawnLine{
      line.at(s0), line.at(s1), point(line, s0), point(line, s1), line.key(s0), line.key(s1), 0};
}

Vec3 ViewProjection::point(const DrawnLine& line, double s) const {
  if (camera_.orthographic) return line.from + (line.to - line.from) * s;
  const double a = line.key_a * (1 - s), b = line.key_b * s;
  return (line.from * a + line.to * b) / (a + b);
}

bool ViewProjection::is_before(double key, double other) const {
  const double slack = 1e-9 * (std::fabs(key) + std::fabs(other));
  return camera_.orthographic ? key < other - slack : key > other + slack;
}

double ViewProjection::units_at(double depth) const {
  if (camera_.orthographic) return scale_;
  return 1 / (camera_.units_per_pixel() * std::max(depth, nearest_));
}

double ViewProjection::facing(Vec3 normal, Vec3 point) const {
  return camera_.orthographic ? -dot(normal, camera_.forward)
                              : dot(normal, normalize(camera_.eye - point));
}

Ray ViewProjection::ray_at(Vec2 place) const {
  if (!camera_.orthographic) return camera_.ray(place.x, place.y);
  return {camera_.eye + camera_.right * (place.x / scale_) - camera_.up * (place.y / scale_),
          camera_.forward, -camera_.ortho_reach};
}

Ray ViewProjection::ray_to(Vec3 point, double& distance) const {
  if (camera_.orthographic) {
    distance = depth(point);
    return {point - camera_.forward * distance, camera_.forward, -camera_.ortho_reach};
  }
  const Vec3 way = point - camera_.eye;
  distance = length(way);
  return {camera_.eye, normalize(way), 0};
}

}  // namespace whittle

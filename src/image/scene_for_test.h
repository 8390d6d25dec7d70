// A few shapes and a tracer of them that shares nothing with the others, for tests of what rays add
// to pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/box.h"
#include "trace/tracer.h"
#include "trace/view.h"

namespace whittle {

class SceneForTest : public Tracer {
 public:
  /// Ids count from 1 in the order of these calls.
  void add_plane(Vec3 normal, double offset) {
    add([=](const Ray& ray) -> Hit {
      const double slope = dot(normal, ray.direction);
      return meeting((offset - dot(normal, ray.origin)) / slope, ray, normal);
    });
  }
  void add_ball(Vec3 center, double radius) {
    add([=](const Ray& ray) -> Hit {
      const Vec3 from = ray.origin - center;
      const double half = dot(from, ray.direction);
      const double root = half * half - dot(from, from) + radius * radius;
      if (root < 0) return {};
      const double near = -half - std::sqrt(root), far = -half + std::sqrt(root);
      const double t = near > ray.t_min ? near : far;
      return meeting(t, ray, normalize(from + ray.direction * t));
    });
  }
  /// The plane x = 0 from z = 0 up to a height.
  void add_wall(double height) {
    add([=](const Ray& ray) -> Hit {
      const double t = -ray.origin.x / ray.direction.x;
      const double z = ray.origin.z + ray.direction.z * t;
      return z >= 0 && z <= height ? meeting(t, ray, {1, 0, 0}) : Hit{};
    });
  }
  void add_box(const Box& box) {
    add([=](const Ray& ray) -> Hit {
      double near = -kInfinity, far = kInfinity;
      Vec3 near_normal, far_normal;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
        const double sign = ray.direction[axis] < 0 ? 1 : -1;
        if (std::min(a, b) > near)
          near = std::min(a, b), near_normal = {}, near_normal[axis] = sign;
        if (std::max(a, b) < far) far = std::max(a, b), far_normal = {}, far_normal[axis] = -sign;
      }
      if (near >= far) return {};
      return near > ray.t_min ? meeting(near, ray, near_normal) : meeting(far, ray, far_normal);
    });
  }

  const char* name() const override { return "scene"; }
  Frame render(const Camera& camera, const RenderControl& = {}) override {
    Frame frame(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        frame.at(x, y) = shoot(camera.ray(double(x) + 0.5, double(y) + 0.5));
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for (size_t i = 0; i < positions.size(); ++i)
      hits[i] = shoot(camera.ray(double(positions[i].x), double(positions[i].y)));
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    cast_rays += rays.size();
    for (size_t i = 0; i < rays.size(); ++i) hits[i] = shoot(rays[i]);
  }

  size_t cast_rays = 0;  ///< so far

 private:
  static Hit meeting(double t, const Ray& ray, Vec3 n) {
    if (!(t > ray.t_min) || !std::isfinite(t)) return {};
    return {float(t), 1, {float(n.x), float(n.y), float(n.z)}};
  }
  void add(std::function<Hit(const Ray&)> shape) { shapes_.push_back(std::move(shape)); }
  Hit shoot(const Ray& ray) const {
    Hit nearest;
    for (size_t i = 0; i < shapes_.size(); ++i) {
      const Hit hit = shapes_[i](ray);
      if (!hit.hit() || hit.distance >= nearest.distance) continue;
      nearest = hit;
      nearest.id = uint32_t(i + 1);
    }
    return nearest;
  }

  std::vector<std::function<Hit(const Ray&)>> shapes_;
};

/// Square, straight down on the origin, `side` model units of it.
inline Camera camera_from_above(int pixels, double side) {
  ViewOptions options;
  options.eye = Vec3{0, 0, 50}, options.center = Vec3{};
  options.orthographic = true;
  options.width = options.height = pixels;
  Camera camera = make_camera(options, {}, {});
  camera.half_height = side / 2;
  return camera;
}

}  // namespace whittle

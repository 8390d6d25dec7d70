#include "image/xray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "image/srgb.h"

namespace whittle {
namespace {

constexpr size_t kRaysPerBatch = size_t(1) << 16;
constexpr size_t kRaysPerTask = 512, kPixelsPerTask = 4096;
/// Tones in linear light that differ by more are an edge.
constexpr float kSameTone = 0.01f;

Vec3f linear(Vec3f srgb) {
  return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

/// What a ray brings: linear light, multiplied by alpha.
struct Tone {
  Vec3f color;
  float alpha = 0;
  uint32_t walls = 0;  ///< a number for the row of statements that it crosses
};

class Xray {
 public:
  Xray(Tracer& tracer, const Camera& camera, std::span<const Appearance> appearances,
       const ShadeSettings& settings, const Workers& workers, const std::stop_token& stop)
      : tracer_(tracer), camera_(camera), settings_(settings), workers_(workers), stop_(stop) {
    const ColorScheme scheme = effective_scheme(settings);
    for (const Appearance& a : appearances)
      inks_.push_back(linear(base_color(a, scheme)) * kXrayInk);
    plain_ink_ = linear(to_unit(scheme.front)) * kXrayInk;
    top_ = linear(to_unit(scheme.background_top));
    bottom_ = linear(to_unit(scheme.background_bottom));
  }

  Picture draw(size_t n) {
    const size_t width = size_t(camera_.width), count = width * size_t(camera_.height);
    std::vector<Tone> lights(count);
    look(
        count,
        [&](size_t i) {
          return PixelPosition{float(i % width) + 0.5f, float(i / width) + 0.5f};
        },
        lights);
    if (n > 1) draw_edges(n, lights);
    Picture picture = Picture::unfilled(camera_.width, camera_.height);
    workers_.for_parts(count, kPixelsPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) store(lights[i], &picture.rgba[4 * i]);
    });
    return picture;
  }

 private:
  /// What comes through `count` places.
  template <class PlaceOf>
  void look(size_t count, const PlaceOf& place_of, std::vector<Tone>& lights) {
    std::vector<Ray> rays;
    RayCrossings found;
    for (size_t begin = 0; begin < count && !stop_.stop_requested(); begin += kRaysPerBatch) {
      const size_t size = std::min(kRaysPerBatch, count - begin);
      rays.resize(size);
      workers_.for_parts(size, kRaysPerTask, [&](size_t first, size_t last, size_t) {
        for (size_t i = first; i < last; ++i) {
          const PixelPosition place = place_of(begin + i);
          rays[i] = camera_.ray(double(place.x), double(place.y));
        }
      });
      tracer_.cast_through(rays, found);
      workers_.for_parts(size, kRaysPerTask, [&](size_t first, size_t last, size_t) {
        for (size_t i = first; i < last; ++i)
          lights[begin + i] = light_of(rays[i], found.of(i), place_of(begin + i));
      });
    }
  }

  Tone light_of(const Ray& ray, std::span<const SurfaceCrossing> walls, PixelPosition place) const {
    Tone light;
    float through = 1;
    for (const SurfaceCrossing& wall : walls) {
      const float held = xray_opacity(std::fabs(dot(ray.direction, wall.normal)));
      const Vec3f ink = wall.id < inks_.size() ? inks_[wall.id] : plain_ink_;
      light.color += ink * (through * held);
      through *= 1 - held;
      light.walls = light.walls * 16777619u + wall.id;
    }
    if (settings_.background) {
      const float down = place.y / float(camera_.height);
      light.color += (top_ * (1 - down) + bottom_ * down) * through;
      through = 0;
    }
    light.alpha = 1 - through;
    return light;
  }

  static bool differ(const Tone& a, const Tone& b) {
    const Vec3f apart = a.color - b.color;
    return a.walls != b.walls || std::fabs(apart.x) > kSameTone || std::fabs(apart.y) > kSameTone ||
           std::fabs(apart.z) > kSameTone || std::fabs(a.alpha - b.alpha) > kSameTone;
  }

  /// Pixels that differ from a neighbour above, below, left or right.
  std::vector<size_t> edges(const std::vector<Tone>& lights) const {
    const size_t width = size_t(camera_.width), height = size_t(camera_.height);
    std::vector<uint8_t> is_edge(lights.size());
    workers_.for_parts(height, 16, [&](size_t first, size_t last, size_t) {
      for (size_t y = first; y < last; ++y) {
        for (size_t x = 0; x < width; ++x) {
          const size_t i = y * width + x;
          is_edge[i] = (x > 0 && differ(lights[i], lights[i - 1])) ||
                       (x + 1 < width && differ(lights[i], lights[i + 1])) ||
                       (y > 0 && differ(lights[i], lights[i - width])) ||
                       (y + 1 < height && differ(lights[i], lights[i + width]));
        }
      }
    });
    std::vector<size_t> places;
    for (size_t i = 0; i < is_edge.size(); ++i)
      if (is_edge[i] != 0) places.push_back(i);
    return places;
  }

  void draw_edges(size_t n, std::vector<Tone>& lights) {
    const std::vector<size_t> all = edges(lights);
    const size_t samples = n * n, width = size_t(camera_.width);
    const size_t batch = std::max<size_t>(1, kRaysPerBatch / samples);
    std::vector<Tone> seen;
    for (size_t begin = 0; begin < all.size() && !stop_.stop_requested(); begin += batch) {
      const size_t size = std::min(batch, all.size() - begin);
      seen.resize(size * samples);
      const auto place_of = [&](size_t i) {
        const size_t pixel = all[begin + i / samples], s = i % samples;
        return PixelPosition{float(pixel % width) + (float(s % n) + 0.5f) / float(n),
                             float(pixel / width) + (float(s / n) + 0.5f) / float(n)};
      };
      look(seen.size(), place_of, seen);
      for (size_t k = 0; k < size; ++k) {
        Tone mean;
        for (size_t s = k * samples; s < (k + 1) * samples; ++s)
          mean.color += seen[s].color, mean.alpha += seen[s].alpha;
        lights[all[begin + k]] = {mean.color / float(samples), mean.alpha / float(samples), 0};
      }
    }
  }

  static void store(const Tone& light, uint8_t* rgba) {
    const Vec3f color = light.alpha > 0 ? light.color / light.alpha : Vec3f{};
    const auto encode = [](float v) {
      return to_8_bits(srgb_from_linear(std::clamp(v, 0.0f, 1.0f)));
    };
    rgba[0] = encode(color.x), rgba[1] = encode(color.y), rgba[2] = encode(color.z);
    rgba[3] = to_8_bits(light.alpha);
  }

  Tracer& tracer_;
  const Camera& camera_;
  const ShadeSettings& settings_;
  const Workers& workers_;
  const std::stop_token stop_;
  std::vector<Vec3f> inks_;  ///< by id
  Vec3f plain_ink_, top_, bottom_;
};

}  // namespace

float xray_opacity(double cosine) {
  return cosine > 0 ? float(-std::expm1(-kXrayThickness / cosine)) : 1.0f;
}

Picture xray_picture(Tracer& tracer, const Camera& camera, std::span<const Appearance> appearances,
                     const ShadeSettings& settings, int n, const Workers& workers,
                     const std::stop_token& stop) {
  return Xray(tracer, camera, appearances, settings, workers, stop).draw(size_t(std::max(n, 1)));
}

}  // namespace whittle

// A tracer that makes its pictures of rays that are no camera's: each starts elsewhere along its
// line, and none is next to its neighbours in the picture.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "trace/tracer.h"

namespace whittle {

class CastingTracer final : public Tracer {
 public:
  /// `inner` must outlive it; `reach` is how far rays are moved at most. Much less than what is
  /// seen is away, for distances are floats.
  CastingTracer(Tracer& inner, double reach) : inner_(inner), reach_(reach) {}

  const char* name() const override { return "casting"; }
  Frame render(const Camera& camera, const RenderControl&) override {
    Frame frame(camera.width, camera.height);
    std::vector<PixelPosition> positions;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        positions.push_back({float(x) + 0.5f, float(y) + 0.5f});
    probe(camera, positions, frame.hits);
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    std::vector<size_t> order(positions.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::shuffle(order, random_);
    std::uniform_real_distribution<double> moved(-reach_, reach_);
    std::vector<Ray> rays;
    std::vector<double> by;
    for (const size_t i : order) {
      Ray ray = camera.ray(double(positions[i].x), double(positions[i].y));
      by.push_back(moved(random_));
      ray.origin += ray.direction * by.back();
      ray.t_min -= by.back();
      rays.push_back(ray);
    }
    std::vector<Hit> found(rays.size());
    cast(rays, found);
    for (size_t k = 0; k < order.size(); ++k) {
      hits[order[k]] = found[k];
      if (found[k].hit()) hits[order[k]].distance = float(double(found[k].distance) + by[k]);
    }
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override { inner_.cast(rays, hits); }

 private:
  Tracer& inner_;
  const double reach_;
  std::mt19937 random_{1};
};

}  // namespace whittle

#include "image/occlusion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/result.h"
#include "image/block_sums.h"
#include "image/directions.h"
#include "image/edge_lanes.h"
#include "image/edge_pixels.h"
#include "image/ordered_cast.h"

namespace whittle {
namespace {

constexpr size_t kPixelsPerTask = size_t(1) << 14;
/// Facets of a curve are one face here: what they see of their surroundings hardly differs.
constexpr float kCosOtherFace = 0.9f;
/// A mean of fewer rays is too rough.
constexpr uint32_t kFewRays = 12;

/// Sends the rays of all hits.
class Looking {
 public:
  Looking(Tracer& tracer, const Camera& camera, const Frame& frame,
          const OcclusionSettings& settings, const Workers& workers)
      : camera_(camera),
        frame_(frame),
        settings_(settings),
        cast_(tracer, size_t(frame.width), workers) {
    const uint32_t count = kBlockDirections * uint32_t(settings.rays);
    for (uint32_t i = 0; i < count; ++i) discs_.push_back(on_disc(spread_point(i, count)));
  }

  /// Those of all senders; adds to their numbers the shares that each sees.
  void look(const std::vector<uint8_t>& senders, const std::stop_token& stop,
            std::vector<uint32_t>& numbers) {
    const size_t width = size_t(frame_.width);
    const std::vector<uint32_t> places =
        places_in_patches(width, size_t(frame_.height),
                          [&](size_t x, size_t y) { return senders[y * width + x] != 0; });
    for (int turn = 0; turn < settings_.rays; ++turn) {
      cast_(
          places, stop,
          [&](uint32_t place) { return ray_from(place, senders[place], uint32_t(turn)); },
          [&](uint32_t place, const Hit& hit) {
            const double seen = 1 - hidden_share(hit, settings_.reach);
            numbers[place] += BlockSums::packed(seen, 0);
          });
    }
  }

 private:
  Ray ray_from(size_t place, size_t step, uint32_t turn) const {
    const size_t x = place % size_t(frame_.width), y = place / size_t(frame_.width);
    const Hit& hit = frame_.hits[place];
    const Ray eye = camera_.ray(double(x) + 0.5, double(y) + 0.5);
    Vec3 normal = normalize(to_double(hit.normal));
    if (dot(normal, eye.direction) > 0) normal = normal * -1;
    const Vec3 point = eye.origin + eye.direction * double(hit.distance);
    const double slack = kLeaveTolerance * std::fabs(double(hit.distance));
    const uint32_t direction = direction_of_pixel(x / step, y / step) + kBlockDirections * turn;
    return {point + normal * slack, Axes(normal).over(discs_[direction]), 0, settings_.reach};
  }

  const Camera& camera_;
  const Frame& frame_;
  const OcclusionSettings settings_;
  OrderedCast cast_;
  std::vector<Vec2> discs_;
};

}  // namespace

double hidden_share(const Hit& hit, double reach) {
  if (!hit.hit()) return 0;
  const double way = std::fmax(0.0, double(hit.distance)) / reach;
  return way < 1 ? (1 - way * way) * (1 - way * way) : 0;
}

std::vector<float> openness(Tracer& tracer, const Camera& camera, const Frame& frame,
                            const OcclusionSettings& settings, const Workers& workers,
                            const std::stop_token& stop) {
  WHITTLE_CHECK(settings.rays > 0 && settings.rays <= kMostOcclusionRays &&
                std::has_single_bit(settings.step) && settings.step <= kMostOcclusionStep);
  const size_t width = size_t(frame.width), height = size_t(frame.height);
  const std::vector<uint8_t> differences = later_differences(frame, camera, workers, kCosOtherFace);
  const BlockSums block_sums(width, height, differences, kDirectionBlock * settings.step, workers);
  const auto for_pixels = [&](const auto& body) {
    workers.for_parts(frame.hits.size(), kPixelsPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) body(i);
    });
  };
  // By pixel: pixels between those of the lattice in which it sends rays; 0: it sends none.
  std::vector<uint8_t> senders(frame.hits.size());
  std::vector<uint32_t> numbers(frame.hits.size());
  const auto count_rays = [&](uint32_t each) {
    for_pixels([&](size_t i) { numbers[i] = senders[i] != 0 ? each : 0; });
  };
  for (size_t step = settings.step; step > 0; step /= 2) {
    if (step < settings.step) {
      count_rays(1);
      block_sums.add_up(numbers);
    }
    for (size_t y = 0; y < height; y += step) {
      for (size_t x = 0; x < width; x += step) {
        const size_t at = y * width + x;
        if (senders[at] == 0 && frame.hits[at].hit() && numbers[at] < kFewRays)
          senders[at] = uint8_t(step);
      }
    }
  }
  count_rays(uint32_t(settings.rays));
  Looking looking(tracer, camera, frame, settings, workers);
  looking.look(senders, stop, numbers);
  block_sums.add_up(numbers);
  for_pixels([&](size_t i) {
    numbers[i] = frame.hits[i].hit() ? BlockSums::packed(BlockSums::mean(numbers[i], 1), 1) : 0;
  });
  BlockSums(width, height, differences, kDirectionBlock, workers).add_up(numbers);
  std::vector<float> open(frame.hits.size(), 1);
  for_pixels([&](size_t i) {
    if (frame.hits[i].hit()) open[i] = float(BlockSums::mean(numbers[i], 1));
  });
  return open;
}

}  // namespace whittle

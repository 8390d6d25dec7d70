#include "image/occlusion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/result.h"
#include "image/directions.h"
#include "image/edge_lanes.h"
#include "image/edge_pixels.h"

namespace whittle {
namespace {

/// Rays that are traced at a time.
constexpr size_t kRaysPerBatch = size_t(1) << 17;
constexpr size_t kRaysPerTask = 2048, kRowsPerTask = 16;
constexpr size_t kPixelsPerTask = size_t(1) << 14;
/// Shares as whole numbers, whose sums are the same in any order.
constexpr double kWhole = 1 << 10;
/// Facets of a curve are one face here: what they see of their surroundings hardly differs.
constexpr float kCosOtherFace = 0.9f;
/// A mean of fewer rays is too rough.
constexpr uint32_t kFewRays = 12;

/// What the rays of a pixel found, in one number: how many they are, and above kRay the sum of the
/// shares that they see. Sums over a block fit.
constexpr uint32_t kRay = 1, kShareShift = 11;
constexpr uint32_t kMostRays = (uint32_t(1) << kShareShift) - 1;

/// Sends the rays of all hits.
class Looking {
 public:
  Looking(Tracer& tracer, const Camera& camera, const Frame& frame,
          const OcclusionSettings& settings, const Workers& workers)
      : tracer_(tracer), camera_(camera), frame_(frame), settings_(settings), workers_(workers) {
    const uint32_t count = kBlockDirections * uint32_t(settings.rays);
    for (uint32_t i = 0; i < count; ++i) discs_.push_back(on_disc(spread_point(i, count)));
  }

  /// Those of the senders of a lattice; adds to their numbers the shares that each sees.
  void look(const std::vector<uint8_t>& senders, size_t step, const std::stop_token& stop,
            std::vector<uint32_t>& numbers) {
    const size_t width = size_t(frame_.width), height = size_t(frame_.height);
    const size_t columns = (width + step - 1) / step;
    std::vector<uint32_t> places = in_walking_order(
        columns, (height + step - 1) / step,
        [&](size_t x, size_t y) { return senders[step * (y * width + x)] == step; },
        direction_of_pixel);
    for (uint32_t& at : places) at = uint32_t(step * (at / columns * width + at % columns));
    look(places, step, stop, numbers);
  }

 private:
  void look(std::span<const uint32_t> places, size_t step, const std::stop_token& stop,
            std::vector<uint32_t>& numbers) {
    for (int turn = 0; turn < settings_.rays; ++turn)
      for (size_t first = 0; first < places.size(); first += kRaysPerBatch) {
        if (stop.stop_requested()) return;
        look(places.subspan(first, std::min(kRaysPerBatch, places.size() - first)), step,
             uint32_t(turn), numbers);
      }
  }

  void look(std::span<const uint32_t> places, size_t step, uint32_t turn,
            std::vector<uint32_t>& numbers) {
    rays_.resize(places.size());
    found_.resize(places.size());
    workers_.for_parts(places.size(), kRaysPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) rays_[i] = ray_from(places[i], step, turn);
    });
    tracer_.cast(rays_, found_);
    workers_.for_parts(places.size(), kRaysPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) {
        const double seen = 1 - hidden_share(found_[i], settings_.reach);
        numbers[places[i]] += uint32_t(seen * kWhole + 0.5) << kShareShift;
      }
    });
  }

  Ray ray_from(size_t place, size_t step, uint32_t turn) const {
    const size_t x = place % size_t(frame_.width), y = place / size_t(frame_.width);
    const Hit& hit = frame_.hits[place];
    const Ray eye = camera_.ray(double(x) + 0.5, double(y) + 0.5);
    Vec3 normal = normalize(to_double(hit.normal));
    if (dot(normal, eye.direction) > 0) normal = normal * -1;
    const Vec3 point = eye.origin + eye.direction * double(hit.distance);
    const double slack = kLeaveTolerance * std::fabs(double(hit.distance));
    return {
        point + normal * slack,
        Axes(normal).over(discs_[direction_of_pixel(x / step, y / step) + kBlockDirections * turn]),
        0};
  }

  Tracer& tracer_;
  const Camera& camera_;
  const Frame& frame_;
  const OcclusionSettings settings_;
  const Workers& workers_;
  std::vector<Vec2> discs_;
  // Scratch space.
  std::vector<Ray> rays_;
  std::vector<Hit> found_;
};

/// Sums over the connected pixels around each pixel: over as many as a block has, so that all
/// directions are among them; where an edge is near, over more on its other side.
class Gathering {
 public:
  Gathering(const Frame& frame, std::span<const uint8_t> differences, size_t step,
            const Workers& workers)
      : differences_(differences),
        workers_(workers),
        width_(size_t(frame.width)),
        height_(size_t(frame.height)),
        others_(uint32_t(kDirectionBlock * step - 1)) {}

  void add_up(std::vector<uint32_t>& numbers) const {
    add_rows(numbers);
    add_columns(numbers);
  }

 private:
  struct Window {
    uint32_t before, after;
  };
  Window window_of(uint32_t before, uint32_t after) const {
    const uint32_t most_after = std::min(after, others_);
    const uint32_t taken = std::min(before, std::max((others_ + 1) / 2, others_ - most_after));
    return {taken, std::min(after, others_ - taken)};
  }

  void add_rows(std::vector<uint32_t>& numbers) const {
    workers_.for_parts(height_, kRowsPerTask, [&](size_t first, size_t last, size_t) {
      std::vector<uint32_t> sums(width_ + 1), before(width_), after(width_);
      for (size_t y = first; y < last; ++y) {
        uint32_t* row = &numbers[y * width_];
        if (std::all_of(row, row + width_, [](uint32_t v) { return v == 0; })) continue;
        const uint8_t* bits = &differences_[y * width_];
        for (size_t x = 1; x < width_; ++x)
          before[x] = bits[x - 1] & kRight ? 0 : before[x - 1] + 1;
        for (size_t x = width_ - 1; x-- > 0;) after[x] = bits[x] & kRight ? 0 : after[x + 1] + 1;
        // Sums may wrap around; their differences are right.
        for (size_t x = 0; x < width_; ++x) sums[x + 1] = sums[x] + row[x];
        for (size_t x = 0; x < width_; ++x) {
          const Window window = window_of(before[x], after[x]);
          row[x] = sums[x + window.after + 1] - sums[x - window.before];
        }
      }
    });
  }

  /// Some columns at a time, so that all that is touched lies side by side.
  void add_columns(std::vector<uint32_t>& numbers) const {
    constexpr size_t kStrip = 64;
    workers_.for_parts((width_ + kStrip - 1) / kStrip, 1, [&](size_t first, size_t last, size_t) {
      std::vector<uint32_t> sums((height_ + 1) * kStrip), before(height_ * kStrip);
      std::vector<uint32_t> after(kStrip);
      for (size_t strip = first; strip < last; ++strip) {
        const size_t x0 = strip * kStrip, columns = std::min(kStrip, width_ - x0);
        for (size_t y = 0; y < height_; ++y) {
          const uint32_t* row = &numbers[y * width_ + x0];
          const uint32_t* sum = &sums[y * kStrip];
          uint32_t* next_sum = &sums[(y + 1) * kStrip];
          for (size_t x = 0; x < columns; ++x) next_sum[x] = sum[x] + row[x];
          if (y == 0) continue;
          const uint8_t* bits = &differences_[(y - 1) * width_ + x0];
          const uint32_t* above = &before[(y - 1) * kStrip];
          uint32_t* here = &before[y * kStrip];
          for (size_t x = 0; x < columns; ++x) here[x] = bits[x] & kBelow ? 0 : above[x] + 1;
        }
        for (size_t y = height_; y-- > 0;) {
          const uint8_t* bits = &differences_[y * width_ + x0];
          for (size_t x = 0; x < columns; ++x) {
            after[x] = y + 1 == height_ || bits[x] & kBelow ? 0 : after[x] + 1;
            const Window window = window_of(before[y * kStrip + x], after[x]);
            numbers[y * width_ + x0 + x] =
                sums[(y + window.after + 1) * kStrip + x] - sums[(y - window.before) * kStrip + x];
          }
        }
      }
    });
  }

  const std::span<const uint8_t> differences_;
  const Workers& workers_;
  const size_t width_, height_;
  const uint32_t others_;  ///< pixels in a row of a block, but one
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
  const Gathering gathering(frame, differences, settings.step, workers);
  const auto for_pixels = [&](const auto& body) {
    workers.for_parts(frame.hits.size(), kPixelsPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) body(i);
    });
  };
  // By pixel: pixels between those of the lattice in which it sends rays; 0: it sends none.
  std::vector<uint8_t> senders(frame.hits.size());
  std::vector<uint32_t> numbers(frame.hits.size());
  const auto count_rays = [&](uint32_t each) {
    for_pixels([&](size_t i) { numbers[i] = senders[i] != 0 ? kRay * each : 0; });
  };
  for (size_t step = settings.step; step > 0; step /= 2) {
    if (step < settings.step) {
      count_rays(1);
      gathering.add_up(numbers);
    }
    for (size_t y = 0; y < height; y += step) {
      for (size_t x = 0; x < width; x += step) {
        const size_t at = y * width + x;
        if (senders[at] == 0 && frame.hits[at].hit() && numbers[at] < kFewRays * kRay)
          senders[at] = uint8_t(step);
      }
    }
  }
  count_rays(uint32_t(settings.rays));
  Looking looking(tracer, camera, frame, settings, workers);
  for (size_t step = settings.step; step > 0; step /= 2) looking.look(senders, step, stop, numbers);
  gathering.add_up(numbers);
  // The mean of so many shares, as one.
  const auto mean = [&](size_t i) {
    const uint32_t rays = numbers[i] & kMostRays;
    return rays > 0 ? double(numbers[i] >> kShareShift) / double(rays) : kWhole;
  };
  for_pixels([&](size_t i) {
    numbers[i] = frame.hits[i].hit() ? kRay | uint32_t(mean(i) + 0.5) << kShareShift : 0;
  });
  Gathering(frame, differences, 1, workers).add_up(numbers);
  std::vector<float> open(frame.hits.size(), 1);
  for_pixels([&](size_t i) {
    if (frame.hits[i].hit()) open[i] = float(mean(i) / kWhole);
  });
  return open;
}

}  // namespace whittle

#include "image/ground.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "image/directions.h"
#include "image/occlusion.h"

namespace whittle {
namespace {

constexpr size_t kStep = 3;  ///< pixels between places
constexpr size_t kRaysPerBatch = size_t(1) << 17, kPlacesPerTask = 1024, kRowsPerTask = 8;
/// The ground sees as far as this share of the solid's diagonal.
constexpr double kReach = 0.6;
/// The lamp's radius over its distance.
constexpr double kLampRadius = 0.28;
/// What sky and lamp give to the ground; the rest comes from everywhere.
constexpr double kSkyShare = 0.45, kLampShare = 0.3;
/// How high the lamp stands at least: its z over its distance, but for a factor.
constexpr double kLowestLamp = 0.5;

/// Whether a ray meets the box at all.
bool meets(const Ray& ray, const Box& box) {
  double near = 0, far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0) {
      if (ray.origin[axis] < box.lo[axis] || ray.origin[axis] > box.hi[axis]) return false;
      continue;
    }
    const double a = (box.lo[axis] - ray.origin[axis]) / d,
                 b = (box.hi[axis] - ray.origin[axis]) / d;
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

/// A lattice of numbers.
struct Lattice {
  size_t columns = 0, rows = 0;
  std::vector<float> numbers;
};

/// Replaces all numbers by their sums over blocks, along rows or along columns.
void add_blocks(Lattice& sums, Lattice& counts, bool along_rows, size_t block,
                const Workers& workers) {
  const size_t stride = along_rows ? 1 : sums.columns;
  const size_t length = along_rows ? sums.columns : sums.rows;
  const size_t across = along_rows ? sums.columns : 1;
  workers.for_parts(along_rows ? sums.rows : sums.columns, kRowsPerTask,
                    [&](size_t first, size_t last, size_t) {
                      std::vector<float> row(length);
                      for (size_t line = first; line < last; ++line) {
                        for (Lattice* lattice : {&sums, &counts}) {
                          float* at = &lattice->numbers[line * across];
                          for (size_t i = 0; i < length; ++i) row[i] = at[i * stride];
                          for (size_t i = 0; i < length; ++i) {
                            float sum = 0;
                            const size_t from = i - std::min(i, block / 2);
                            const size_t to = std::min(length, i + block - block / 2);
                            for (size_t k = from; k < to; ++k) sum += row[k];
                            at[i * stride] = sum;
                          }
                        }
                      }
                    });
}

}  // namespace

Ground::Ground(Tracer& tracer, const Camera& camera, const Frame& frame,
               const ShadeSettings& settings, const Workers& workers, const std::stop_token& stop) {
  const Box& solid = settings.solid;
  if (solid.is_empty() || !solid.is_finite()) return;
  const size_t width = size_t(frame.width), height = size_t(frame.height);
  columns_ = (width + kStep - 1) / kStep;
  rows_ = (height + kStep - 1) / kStep;
  const Axes up({0, 0, 1});
  const Vec3 key = lights(camera, settings).front().at;
  // A lamp that stands low would draw shadows without end.
  const Axes lamp(normalize(Vec3{key.x, key.y, std::max(key.z, kLowestLamp)}));
  std::array<Vec2, kBlockDirections> discs;
  for (uint32_t i = 0; i < kBlockDirections; ++i)
    discs[i] = on_disc(spread_point(i, kBlockDirections));

  // The ground that is seen through a place of the lattice, the middle of a pixel.
  const auto ground_at = [&](size_t i, size_t j) -> std::optional<Vec3> {
    const size_t x = kStep * i, y = kStep * j;
    if (frame.hits[y * width + x].hit()) return std::nullopt;
    const Ray ray = camera.ray(double(x) + 0.5, double(y) + 0.5);
    if (!(ray.direction.z < 0)) return std::nullopt;
    const double t = (solid.lo.z - ray.origin.z) / ray.direction.z;
    if (!(t > ray.t_min)) return std::nullopt;
    return ray.origin + ray.direction * t;
  };
  const auto to_sky = [&](size_t i, size_t j) { return up.over(discs[direction_of_pixel(i, j)]); };
  const auto to_lamp = [&](size_t i, size_t j) {
    const Vec2 disc = discs[direction_of_pixel(i, j)];
    return normalize(lamp.z + (lamp.x * disc.x + lamp.y * disc.y) * kLampRadius);
  };

  Lattice counts{columns_, rows_, std::vector<float>(columns_ * rows_)}, sums = counts;
  const auto for_places = [&](const auto& body) {
    workers.for_parts(rows_, kRowsPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t j = first; j < last; ++j)
        for (size_t i = 0; i < columns_; ++i) body(j * columns_ + i, i, j);
    });
  };
  for_places([&](size_t at, size_t i, size_t j) { counts.numbers[at] = ground_at(i, j) ? 1 : 0; });
  bool is_shaded = false;
  const auto look = [&](const auto& direction, double reach, double share) {
    // Those that have the solid's box in their way.
    std::vector<uint8_t> may_meet(columns_ * rows_);
    for_places([&](size_t at, size_t i, size_t j) {
      if (counts.numbers[at] != 0) may_meet[at] = meets({*ground_at(i, j), direction(i, j)}, solid);
    });
    const std::vector<uint32_t> places = in_walking_order(
        columns_, rows_, [&](size_t i, size_t j) { return may_meet[j * columns_ + i] != 0; },
        direction_of_pixel);
    is_shaded |= !places.empty();
    std::vector<Ray> rays;
    std::vector<Hit> found;
    for (size_t first = 0; first < places.size(); first += kRaysPerBatch) {
      if (stop.stop_requested()) return;
      const auto batch =
          std::span(places).subspan(first, std::min(kRaysPerBatch, places.size() - first));
      rays.resize(batch.size()), found.resize(batch.size());
      workers.for_parts(batch.size(), kPlacesPerTask, [&](size_t begin, size_t end, size_t) {
        for (size_t k = begin; k < end; ++k) {
          const size_t i = batch[k] % columns_, j = batch[k] / columns_;
          rays[k] = {*ground_at(i, j), direction(i, j)};
        }
      });
      tracer.cast(rays, found);
      for (size_t k = 0; k < batch.size(); ++k)
        sums.numbers[batch[k]] += float(share * hidden_share(found[k], reach));
    }
  };
  look(to_sky, kReach * solid.diagonal(), kSkyShare);
  look(to_lamp, kInfinity, kLampShare);
  if (!is_shaded) return;
  for (const size_t block : {kDirectionBlock, kDirectionBlock / 2})
    for (const bool along_rows : {true, false})
      add_blocks(sums, counts, along_rows, block, workers);
  shadows_ = std::move(sums.numbers);
  for (size_t i = 0; i < shadows_.size(); ++i)
    shadows_[i] = counts.numbers[i] > 0 ? shadows_[i] / counts.numbers[i] : 0;
}

float Ground::shadow(float px, float py) const {
  if (shadows_.empty()) return 0;
  // Between the four places around.
  const auto split = [](float p, size_t count, size_t& first, size_t& second) {
    const float at = std::clamp((p - 0.5f) / float(kStep), 0.0f, float(count - 1));
    first = size_t(at);
    second = std::min(first + 1, count - 1);
    return at - float(first);
  };
  size_t x0, x1, y0, y1;
  const float u = split(px, columns_, x0, x1), v = split(py, rows_, y0, y1);
  const auto at = [&](size_t x, size_t y) { return shadows_[y * columns_ + x]; };
  return (at(x0, y0) * (1 - u) + at(x1, y0) * u) * (1 - v) +
         (at(x0, y1) * (1 - u) + at(x1, y1) * u) * v;
}

}  // namespace whittle

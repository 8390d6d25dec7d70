#include "image/ground.h"

#include <algorithm>
#include <array>
#include <optional>

#include "image/block_sums.h"
#include "image/directions.h"
#include "image/edge_lanes.h"
#include "image/occlusion.h"
#include "image/ordered_cast.h"

namespace whittle {
namespace {

/// Places along the shorter side of a picture, about: shadows are as soft in large pictures as in
/// small ones.
constexpr size_t kPlaces = 200;
constexpr size_t kRowsPerTask = 8;
constexpr size_t kAroundOutline = 4;  ///< places, both ways
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

/// Which later neighbours of a lattice's places are another kind of place.
std::vector<uint8_t> changes_in(const std::vector<uint8_t>& kinds, size_t columns,
                                const Workers& workers) {
  const size_t rows = kinds.size() / columns;
  std::vector<uint8_t> changes(kinds.size());
  workers.for_parts(rows, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t at = first * columns; at < last * columns; ++at) {
      if (at % columns + 1 < columns && kinds[at] != kinds[at + 1]) changes[at] |= kRight;
      if (at + columns < kinds.size() && kinds[at] != kinds[at + columns]) changes[at] |= kBelow;
    }
  });
  return changes;
}

}  // namespace

Ground::Ground(Tracer& tracer, const Camera& camera, const Frame& frame,
               const ShadeSettings& settings, const Workers& workers, const std::stop_token& stop) {
  const Box& solid = settings.solid;
  if (solid.is_empty() || !solid.is_finite()) return;
  const size_t width = size_t(frame.width), height = size_t(frame.height);
  step_ = std::max<size_t>(1, (std::min(width, height) + kPlaces / 2) / kPlaces);
  columns_ = (width + step_ - 1) / step_;
  rows_ = (height + step_ - 1) / step_;
  const Axes up({0, 0, 1});
  const Vec3 key = lights(camera, settings).front().at;
  // A lamp that stands low would draw shadows without end.
  const Axes lamp(normalize(Vec3{key.x, key.y, std::max(key.z, kLowestLamp)}));
  std::array<Vec2, kBlockDirections> discs;
  for (uint32_t i = 0; i < kBlockDirections; ++i)
    discs[i] = on_disc(spread_point(i, kBlockDirections));

  // The ground that is seen through a place of the lattice, the middle of a pixel.
  const auto ground_at = [&](size_t i, size_t j) -> std::optional<Vec3> {
    const size_t x = step_ * i, y = step_ * j;
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

  const size_t count = columns_ * rows_;
  const auto for_places = [&](const auto& body) {
    workers.for_parts(rows_, kRowsPerTask, [&](size_t first, size_t last, size_t) {
      for (size_t j = first; j < last; ++j)
        for (size_t i = 0; i < columns_; ++i) body(j * columns_ + i, i, j);
    });
  };
  std::vector<uint8_t> is_ground(count);
  for_places([&](size_t at, size_t i, size_t j) { is_ground[at] = ground_at(i, j) ? 1 : 0; });
  std::vector<uint32_t> numbers(is_ground.begin(), is_ground.end());
  bool is_shaded = false;
  OrderedCast cast(tracer, columns_, workers);
  const auto look = [&](const auto& direction, double reach, double share) {
    // Those that have the solid's box in their way.
    std::vector<uint8_t> may_meet(count);
    for_places([&](size_t at, size_t i, size_t j) {
      if (is_ground[at] != 0) may_meet[at] = meets({*ground_at(i, j), direction(i, j)}, solid);
    });
    const std::vector<uint32_t> places = places_in_patches(
        columns_, rows_, [&](size_t i, size_t j) { return may_meet[j * columns_ + i] != 0; });
    is_shaded |= !places.empty();
    const auto ray_of = [&](size_t place) {
      const size_t i = place % columns_, j = place / columns_;
      return Ray{*ground_at(i, j), direction(i, j), 0, reach};
    };
    cast(places, stop, ray_of, [&](uint32_t place, const Hit& hit) {
      numbers[place] += BlockSums::packed(share * hidden_share(hit, reach), 0);
    });
  };
  look(to_sky, kReach * solid.diagonal(), kSkyShare);
  look(to_lamp, kInfinity, kLampShare);
  if (!is_shaded) return;
  // A mean without some of the directions would be lighter or darker than its neighbours; where the
  // solid hides the ground it is over more on the other side.
  const std::vector<uint8_t> changes = changes_in(is_ground, columns_, workers);
  const BlockSums block_sums(columns_, rows_, changes, kDirectionBlock, workers);
  block_sums.add_up(numbers);
  for_places([&](size_t at, size_t, size_t) {
    numbers[at] = is_ground[at] != 0 ? BlockSums::packed(BlockSums::mean(numbers[at], 0), 1) : 0;
  });
  block_sums.add_up(numbers);
  // Where the solid hides the ground, what is seen of it around: between places at its outline.
  std::vector<uint32_t> around(count);
  for_places([&](size_t at, size_t, size_t) {
    around[at] = is_ground[at] != 0 ? BlockSums::packed(BlockSums::mean(numbers[at], 0), 1) : 0;
  });
  const std::vector<uint8_t> no_changes(count);
  BlockSums(columns_, rows_, no_changes, kAroundOutline, workers).add_up(around);
  shadows_.resize(count);
  for_places([&](size_t at, size_t, size_t) {
    shadows_[at] = float(BlockSums::mean(is_ground[at] != 0 ? numbers[at] : around[at], 0));
  });
}

float Ground::shadow(float px, float py) const {
  if (shadows_.empty()) return 0;
  // Between the four places around.
  const auto split = [this](float p, size_t count, size_t& first, size_t& second) {
    const float at = std::clamp((p - 0.5f) / float(step_), 0.0f, float(count - 1));
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

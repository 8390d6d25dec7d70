// Casts a ray from each of many places of a picture, so ordered that rays walk together which start
// near one another and go nearly the same way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/workers.h"
#include "trace/tracer.h"

namespace whittle {

/// The numbers y * columns + x of those places of a lattice for which looks(x, y) is true, a square
/// patch after the other.
template <class Looks>
std::vector<uint32_t> places_in_patches(size_t columns, size_t rows, const Looks& looks) {
  constexpr size_t kPatch = 128;
  std::vector<uint32_t> places;
  for (size_t y0 = 0; y0 < rows; y0 += kPatch)
    for (size_t x0 = 0; x0 < columns; x0 += kPatch)
      for (size_t y = y0; y < std::min(y0 + kPatch, rows); ++y)
        for (size_t x = x0; x < std::min(x0 + kPatch, columns); ++x)
          if (looks(x, y)) places.push_back(uint32_t(y * columns + x));
  return places;
}

/// Its memory serves all calls.
class OrderedCast {
 public:
  /// Rays that are ordered and cast at a time.
  static constexpr size_t kMostRays = size_t(1) << 17;

  /// Places are numbers y * columns + x.
  OrderedCast(Tracer& tracer, size_t columns, const Workers& workers)
      : tracer_(tracer), columns_(columns), workers_(workers) {}

  /// Calls use(place, hit) for what the ray meets that ray_of(place) returns, of every place; both
  /// from any thread. Places had better be near those that stand before them. Once a stop is
  /// requested it returns soon, and not all places have been used.
  template <class RayOf, class Use>
  void operator()(std::span<const uint32_t> places, const std::stop_token& stop,
                  const RayOf& ray_of, const Use& use) {
    for (size_t first = 0; first < places.size() && !stop.stop_requested(); first += kMostRays)
      cast(places.subspan(first, std::min(kMostRays, places.size() - first)), ray_of, use);
  }

 private:
  struct Started {
    uint32_t way;    ///< rays that go similar ways from similar places have similar numbers
    uint32_t place;  ///< among those at hand
    Ray ray;
  };
  static constexpr size_t kPart = 2048;  ///< rays are ordered among so many

  template <class RayOf, class Use>
  void cast(std::span<const uint32_t> places, const RayOf& ray_of, const Use& use) {
    rays_.resize(places.size());
    from_.resize(places.size());
    found_.resize(places.size());
    const size_t parts = (places.size() + kPart - 1) / kPart;
    const auto for_parts = [&](const auto& body) {
      workers_.for_parts(parts, 1, [&](size_t begin, size_t end, size_t) {
        for (size_t part = begin; part < end; ++part)
          body(part * kPart, std::min((part + 1) * kPart, places.size()));
      });
    };
    for_parts([&](size_t first, size_t last) {
      std::vector<Started> started(last - first);
      for (size_t i = first; i < last; ++i) {
        const Ray ray = ray_of(places[i]);
        started[i - first] = {way_of(places[i] % columns_, places[i] / columns_, ray.direction),
                              places[i], ray};
      }
      std::ranges::sort(started, [](const Started& a, const Started& b) {
        return a.way != b.way ? a.way < b.way : a.place < b.place;
      });
      for (size_t i = first; i < last; ++i) {
        rays_[i] = started[i - first].ray;
        from_[i] = started[i - first].place;
      }
    });
    tracer_.cast(rays_, found_);
    for_parts([&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) use(from_[i], found_[i]);
    });
  }

  /// First by octant, since cells are met in another order in each; then by place, a block after
  /// the other; then by direction.
  static uint32_t way_of(size_t x, size_t y, Vec3 direction);

  Tracer& tracer_;
  const size_t columns_;
  const Workers& workers_;
  std::vector<Ray> rays_;
  std::vector<uint32_t> from_;  ///< by ray: its place
  std::vector<Hit> found_;
};

}  // namespace whittle

#include "boundary/point_table.h"

#include <bit>

namespace whittle {
namespace {

uint64_t hash_of(const ExactPoint& point) {
  uint64_t hash = 0;
  for (const int64_t part : point.floor)
    hash = (hash ^ uint64_t(part)) * 0x9e3779b97f4a7c15, hash ^= hash >> 29;
  return hash;
}

}  // namespace

std::vector<ExactPoint> unify(std::span<const ExactPoint> points, const ExactGeometry& geometry,
                              std::vector<uint32_t>& numbers) {
  constexpr uint32_t kFree = UINT32_MAX;
  const size_t size = std::bit_ceil(2 * points.size() + 1);
  std::vector<uint32_t> places(size, kFree);
  std::vector<ExactPoint> different;
  numbers.clear();
  numbers.reserve(points.size());
  for (const ExactPoint& point : points) {
    size_t at = hash_of(point) & (size - 1);
    while (places[at] != kFree && !geometry.is_same(point, different[places[at]]))
      at = (at + 1) & (size - 1);
    if (places[at] == kFree) {
      places[at] = uint32_t(different.size());
      different.push_back(point);
    }
    numbers.push_back(places[at]);
  }
  return different;
}

}  // namespace whittle

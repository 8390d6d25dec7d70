#include "boundary/point_table.h"

#include "boundary/numbering.h"

namespace whittle {
namespace {

uint32_t hash_of(const ExactPoint& point) {
  uint64_t hash = 0;
  for (const int64_t part : point.floor) hash = add_to_hash(hash, uint64_t(part));
  return uint32_t(hash);
}

}  // namespace

std::vector<ExactPoint> unify(std::span<const ExactPoint> points, const ExactGeometry& geometry,
                              const Workers& workers, std::vector<uint32_t>& numbers) {
  Numbering numbering = number_equals(
      points.size(), [&](size_t i) { return hash_of(points[i]); },
      [&](size_t i, size_t j) { return geometry.is_same(points[i], points[j]); }, workers);
  std::vector<ExactPoint> different;
  different.reserve(numbering.firsts.size());
  for (const uint32_t first : numbering.firsts) different.push_back(points[first]);
  numbers = std::move(numbering.numbers);
  return different;
}

}  // namespace whittle

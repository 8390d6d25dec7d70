#include "boundary/cutting_planes.h"

#include <algorithm>
#include <bit>

namespace whittle {

CuttingPlanes::CuttingPlanes(const Box& region, size_t faces, const ExactGrid& grid,
                             PlaneTable& planes) {
  const auto count = size_t(1) << std::clamp(int(std::bit_width(faces)) / 2 + 2, 3, 12);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = size_t(axis);
    region_.lo[i] = planes.add(grid.square_plane(axis, region.lo[axis]));
    region_.hi[i] = planes.add(grid.square_plane(axis, region.hi[axis]));
    for (size_t k = 1; k < count; ++k) {
      const double at = region.lo[axis] + region.size()[axis] * (double(k) / double(count));
      cuts_[i].push_back({planes.add(grid.square_plane(axis, at)), at});
    }
  }
}

std::optional<CuttingPlanes::Cut> CuttingPlanes::between(int axis, double lo, double hi) const {
  const std::vector<Cut>& cuts = cuts_[size_t(axis)];
  const auto first = std::upper_bound(cuts.begin(), cuts.end(), lo,
                                      [](double at, const Cut& cut) { return at < cut.at; });
  const auto last = std::lower_bound(first, cuts.end(), hi,
                                     [](const Cut& cut, double at) { return cut.at < at; });
  if (first == last) return std::nullopt;
  // Of a row of numbers one has the most zeros at its end.
  const auto low = uint32_t(first - cuts.begin()) + 1, high = uint32_t(last - cuts.begin());
  const uint32_t differing = std::bit_width(low ^ high);
  const uint32_t best = differing == 0 ? low : high >> (differing - 1) << (differing - 1);
  return cuts[best - 1];
}

}  // namespace whittle

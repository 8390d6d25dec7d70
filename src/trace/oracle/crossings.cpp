#include "trace/oracle/crossings.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace whittle {

Coincidence::Coincidence(const Bounds& bounds) : distance(tolerance(bounds)) {}

bool Coincidence::holds(const Crossing& a, const Crossing& b, Vec3 direction) const {
  if (a.t == b.t) return true;
  const double steepness =
      std::max(std::fabs(dot(a.normal, direction)), std::fabs(dot(b.normal, direction)));
  return std::fabs(b.t - a.t) * steepness <= distance && length(cross(a.normal, b.normal)) <= angle;
}

void group_crossings(std::vector<Crossing>& crossings, Vec3 direction,
                     const Coincidence& coincidence, std::vector<size_t>& group_ends) {
  group_ends.clear();
  std::ranges::sort(crossings, {},
                    [](const Crossing& c) { return std::tuple(c.t, c.leaf, !c.enters); });
  for (size_t begin = 0; begin < crossings.size();) {
    const Crossing first = crossings[begin];
    // No crossing farther off than this can coincide with the first, whatever its own slope.
    const double reach = coincidence.distance / std::fabs(dot(first.normal, direction));
    size_t end = begin + 1;
    for (size_t i = end; i < crossings.size(); ++i) {
      if (crossings[i].t != first.t && !(crossings[i].t - first.t <= reach)) break;
      if (!coincidence.holds(first, crossings[i], direction)) continue;
      // Those between keep their order behind the group.
      std::rotate(crossings.begin() + std::ptrdiff_t(end), crossings.begin() + std::ptrdiff_t(i),
                  crossings.begin() + std::ptrdiff_t(i) + 1);
      ++end;
    }
    group_ends.push_back(end);
    begin = end;
  }
}

}  // namespace whittle

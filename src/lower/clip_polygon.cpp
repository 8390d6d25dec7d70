#include "lower/clip_polygon.h"

#include <algorithm>

namespace whittle {
namespace {

/// Keeps what is at sign * q[axis] <= limit (Sutherland and Hodgman, Reentrant polygon clipping,
/// 1974).
void clip(std::vector<Vec3>& polygon, int axis, int sign, double limit) {
  const size_t n = polygon.size();
  const auto at = [&](Vec3 q) { return sign * q[axis] - limit; };
  if (std::ranges::all_of(polygon, [&](Vec3 q) { return at(q) <= 0; })) return;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 p = polygon[i], q = polygon[(i + 1) % n];
    const double at_p = at(p), at_q = at(q);
    if (at_p <= 0) polygon.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      polygon.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  polygon.erase(polygon.begin(), polygon.begin() + std::ptrdiff_t(n));
}

}  // namespace

void clip_to_box(std::vector<Vec3>& polygon, Vec3 half) {
  for (int axis = 0; axis < 3 && !polygon.empty(); ++axis) {
    clip(polygon, axis, 1, half[axis]);
    clip(polygon, axis, -1, half[axis]);
  }
}

}  // namespace whittle

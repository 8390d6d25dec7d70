#include "flat/convex_hull.h"

#include <algorithm>

#include "flat/orientation.h"

namespace whittle {

Contour hull_contour(std::vector<Vec2> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  // The lower side from left to right, then the upper one back. (Andrew, Another efficient
  // algorithm for convex hulls in two dimensions, Information Processing Letters 9, 1979.)
  Contour hull;
  const auto add_side = [&](auto first, auto last) {
    const size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() > start + 1 &&
             orientation(hull[hull.size() - 2], hull.back(), *first) <= 0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();
  };
  if (points.size() < 3) return {};
  add_side(points.begin(), points.end());
  add_side(points.rbegin(), points.rend());
  return hull.size() < 3 ? Contour{} : hull;
}

Polygons convex_hull(std::span<const Polygons> operands) {
  std::vector<Vec2> points;
  for (const Polygons& operand : operands)
    for (const Contour& contour : operand.contours)
      for (const Vec2 corner : contour)
        if (is_finite(corner)) points.push_back(corner);
  Contour hull = hull_contour(std::move(points));
  if (hull.empty()) return {};
  return {{std::move(hull)}};
}

}  // namespace whittle

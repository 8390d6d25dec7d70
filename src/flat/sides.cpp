#include "flat/sides.h"

#include <algorithm>
#include <cmath>

namespace whittle {

namespace {

/// Of the largest coordinate: a corner so near to the line between its neighbours is no bend. Two
/// steps of the grid of Booleans, which is what may come of a straight edge that they divide.
constexpr double kStraight = 0x1p-32;

double reach(const WeldedPolygons& polygons) {
  double most = 0;
  for (const Vec2 p : polygons.points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  return most;
}

/// Whether `middle` lies between a and b and no farther than `slack` from the line through them.
bool is_straight(Vec2 a, Vec2 middle, Vec2 b, double slack) {
  const Vec2 along = b - a, to = middle - a;
  const double size = length(along);
  if (!(size > 0)) return false;
  const Vec2 unit = along * (1 / size);
  const double ahead = dot(unit, to);
  return std::abs(cross(unit, to)) <= slack && ahead > 0 && ahead < size;
}

}  // namespace

std::vector<ContourSide> sides(const WeldedPolygons& polygons) {
  const double slack = kStraight * reach(polygons);
  std::vector<ContourSide> all;
  for (const std::vector<uint32_t>& contour : polygons.contours) {
    const size_t n = contour.size();
    const auto at = [&](size_t i) { return polygons.points[contour[i % n]]; };
    double twice_area = 0;
    for (size_t i = 0; i < n; ++i) twice_area += cross(at(i) - at(0), at(i + 1) - at(0));
    const bool is_hole = twice_area < 0;
    // From a corner that is a bend, so that no run is cut; any will do if there is none.
    size_t start = 0;
    while (start < n && is_straight(at(start + n - 1), at(start), at(start + 1), slack)) ++start;
    if (start == n) start = 0;
    for (size_t i = start; i < start + n;) {
      // A run goes on while each of its corners stays on the line of its ends. Only a few of them
      // are looked at, which is enough for a run that is made of equal pieces.
      size_t end = i + 1;
      while (end < start + n && is_straight(at(i), at(end), at(end + 1), slack) &&
             is_straight(at(i), at(i + (end + 1 - i) / 2), at(end + 1), slack))
        ++end;
      for (size_t k = i; k < end; ++k)
        all.push_back({contour[k % n], contour[(k + 1) % n], at(i), at(end), is_hole});
      i = end;
    }
  }
  return all;
}

}  // namespace whittle

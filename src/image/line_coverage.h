// Which pixels a line covers, and how much of each.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace whittle {

/// Calls visit(x, y, along, covered) for the pixels of a picture that a line with round ends covers
/// in part; `radius` is half of its width, in pixels, `along` where on the line the nearest point
/// is, 0 to 1. A line of no length is a dot. Precondition: the ends are finite, and not many times
/// the picture's size away from it.
template <class Visit>
void for_covered_pixels(Vec2 from, Vec2 to, double radius, int width, int height,
                        const Visit& visit) {
  const Vec2 way = to - from;
  const double squared = dot(way, way);
  const bool is_flat = std::fabs(way.x) >= std::fabs(way.y);
  // Along the axis in which it goes farther, line by line.
  const double start = is_flat ? from.x : from.y, length = is_flat ? way.x : way.y;
  const double start_across = is_flat ? from.y : from.x, across = is_flat ? way.y : way.x;
  const int size = is_flat ? width : height, size_across = is_flat ? height : width;
  const double slope = length != 0 ? across / length : 0;
  // Half of how far the line's ink reaches, measured along a column or row.
  const double reach = (radius + 0.5) * std::sqrt(1 + slope * slope);
  const auto pixel = [](double v, int pixels) {
    return int(std::clamp(std::floor(v), -1.0, double(pixels)));
  };
  const double lowest = std::min(start, start + length) - reach,
               highest = std::max(start, start + length) + reach;
  const int first = std::max(0, pixel(lowest, size)),
            last = std::min(size - 1, pixel(highest, size));
  for (int i = first; i <= last; ++i) {
    const double middle = start_across + slope * (i + 0.5 - start);
    const int lower = std::max(0, pixel(middle - reach, size_across)),
              upper = std::min(size_across - 1, pixel(middle + reach, size_across));
    for (int j = lower; j <= upper; ++j) {
      const int x = is_flat ? i : j, y = is_flat ? j : i;
      const Vec2 p = Vec2{x + 0.5, y + 0.5} - from;
      const double along = squared > 0 ? std::clamp(dot(p, way) / squared, 0.0, 1.0) : 0;
      const double off = std::hypot(p.x - along * way.x, p.y - along * way.y);
      const double covered = std::clamp(radius + 0.5 - off, 0.0, 1.0);
      if (covered > 0) visit(x, y, along, covered);
    }
  }
}

}  // namespace whittle

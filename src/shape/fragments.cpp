#include "shape/fragments.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/degrees.h"

namespace whittle {

int fragments(double r, FragmentSettings settings) {
  // 2^-20: OpenSCAD's smallest length.
  if (r < 0x1p-20 || !std::isfinite(settings.fn)) return 3;
  const double fa = std::fmax(settings.fa, 0.01), fs = std::fmax(settings.fs, 0.01);
  const double n =
      std::ceil(settings.fn > 0 ? std::fmax(settings.fn, 3)
                                : std::fmax(std::fmin(360 / fa, 2 * std::numbers::pi * r / fs), 5));
  constexpr int kMost = std::numeric_limits<int>::max();
  return n < kMost ? int(n) : kMost;
}

int choose_facets(double r, FragmentSettings settings, Curves curves) {
  if (curves == Curves::kSmooth) return 0;
  // A $fn that is not a number counts as given: OpenSCAD makes triangles of it.
  const bool is_curve = settings.fn <= 0;
  if (curves == Curves::kAuto && is_curve) return 0;
  if (curves == Curves::kOpenscad2021 && !is_curve) {
    settings.fn = std::floor(std::fmax(settings.fn, 3));
  }
  const int n = fragments(r, settings);
  return n > kMaxFacets ? 0 : n;
}

std::vector<Vec3> unit_circle(int n) {
  std::vector<Vec3> points;
  points.reserve(size_t(n));
  for (int k = 0; k < n; ++k)
    points.push_back({cos_degrees(360.0 * k / n), sin_degrees(360.0 * k / n), 0});
  return points;
}

std::vector<Vec3> side_middles(int n) {
  std::vector<Vec3> directions;
  directions.reserve(size_t(n));
  for (int k = 0; k < n; ++k) {
    const double degrees = 180.0 * (2.0 * k + 1) / n;
    directions.push_back({cos_degrees(degrees), sin_degrees(degrees), 0});
  }
  return directions;
}

}  // namespace whittle

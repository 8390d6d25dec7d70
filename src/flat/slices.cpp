#include "flat/slices.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "base/degrees.h"
#include "shape/fragments.h"

namespace whittle {

namespace {

/// OpenSCAD takes radii below this for points.
constexpr double kPointRadius = 0x1p-20;

double clamped_fn(const FragmentSettings& settings) {
  return std::max(settings.fn, 0.0);
}
double clamped_fa(const FragmentSettings& settings) {
  return std::max(settings.fa, 0.01);
}
double clamped_fs(const FragmentSettings& settings) {
  return std::max(settings.fs, 0.01);
}

template <class Measure>
double largest(const Polygons& polygons, const Measure& measure) {
  double most = 0;
  for (const Contour& contour : polygons.contours)
    for (const Vec2 corner : contour)
      if (is_finite(corner)) most = std::max(most, measure(corner));
  return most;
}

/// The length of the spiral of Archimedes r = a * angle from its middle.
double spiral_length(double a, double angle) {
  return 0.5 * a * (angle * std::sqrt(1 + angle * angle) + std::asinh(angle));
}

/// How long the path of a point is that starts at radius r, is turned and scaled by one factor.
double turned_length(double r, double height, double radians, double scale) {
  if (scale == 1) return std::hypot(r * radians, height);
  const double end = scale > 1 ? radians * scale / (scale - 1) : radians / (1 - scale);
  const double a = r / end;
  return std::hypot(spiral_length(a, end) - spiral_length(a, end - radians), height);
}

double twist_slices(double r, double height, double twist, double scale,
                    const FragmentSettings& settings) {
  twist = std::abs(twist);
  const double least = std::max(std::ceil(twist / 120), 1.0), fn = clamped_fn(settings);
  if (!(r >= kPointRadius) || !std::isfinite(settings.fn)) return least;
  if (fn > 0) return std::max(std::ceil(twist / 360 * fn), least);
  const double by_angle = std::ceil(twist / clamped_fa(settings));
  const double length = turned_length(r, height, twist * std::numbers::pi / 180, scale);
  const double by_length = std::ceil(length / clamped_fs(settings));
  return std::max(std::min(by_angle, by_length), least);
}

/// `shift`: the farthest that scaling moves a point.
double scale_slices(double shift, double height, const FragmentSettings& settings) {
  const double fn = clamped_fn(settings);
  if (!(shift >= kPointRadius) || !std::isfinite(settings.fn)) return 1;
  if (fn > 0) return std::max(std::ceil(fn), 1.0);
  return std::max(std::ceil(std::hypot(shift, height) / clamped_fs(settings)), 1.0);
}

double chosen_slices(const Polygons& polygons, const LinearExtrude& how) {
  const bool unequal = how.scale.x != how.scale.y;
  const double r = largest(polygons, [](Vec2 p) { return length(p); });
  double count = 1;
  if (how.twist_degrees != 0)
    count =
        twist_slices(r, how.height, how.twist_degrees, unequal ? 1 : how.scale.x, how.fragments);
  if (unequal) {
    const double shift = largest(polygons, [&](Vec2 p) {
      return length(Vec2{p.x * (1 - how.scale.x), p.y * (1 - how.scale.y)});
    });
    count = std::max(count, scale_slices(shift, how.height, how.fragments));
  }
  return count;
}

/// The longest that each edge becomes in a slice.
std::vector<double> longest_lengths(const Contour& contour, const LinearExtrude& how, int slices) {
  std::vector<double> lengths(contour.size());
  // Turning alone changes no length, and under one factor the bottom or the top is the longest.
  const int first = how.scale.x == how.scale.y ? slices : 1;
  const auto measure = [&](double t) {
    for (size_t i = 0; i < contour.size(); ++i) {
      const Vec2 edge = contour[(i + 1) % contour.size()] - contour[i];
      lengths[i] = std::max(lengths[i], length(slice_point(how, t, edge)));
    }
  };
  measure(0);
  for (int j = first; j <= slices; ++j) measure(double(j) / slices);
  return lengths;
}

Contour divided(const Contour& contour, const std::vector<double>& parts) {
  Contour result;
  for (size_t i = 0; i < contour.size(); ++i) {
    const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
    result.push_back(a);
    for (double k = 1; k < parts[i]; ++k) result.push_back(a + (b - a) * (k / parts[i]));
  }
  return result;
}

double sum(const std::vector<double>& parts) {
  double total = 0;
  for (const double count : parts) total += count;
  return total;
}

/// Parts no longer than `size`.
std::vector<double> parts_by_size(const std::vector<double>& lengths, double size) {
  std::vector<double> parts;
  parts.reserve(lengths.size());
  for (const double length : lengths) parts.push_back(std::max(std::ceil(length / size), 1.0));
  return parts;
}

/// `count` parts in all, or a few less: the edges with the longest parts get one more, all at a
/// time whose parts are equally long, as long as there is room for all of them.
std::vector<double> parts_by_count(const std::vector<double>& lengths, double count) {
  constexpr double kEqual = 0.999;
  struct Candidate {
    double length;  ///< of a part, were there half a part more
    size_t edge;
    bool operator<(const Candidate& other) const {
      return length != other.length ? length < other.length : edge < other.edge;
    }
  };
  std::vector<double> parts(lengths.size(), 1);
  std::priority_queue<Candidate> candidates;
  for (size_t i = 0; i < lengths.size(); ++i) candidates.push({lengths[i] / 1.5, i});
  double total = double(lengths.size());
  std::vector<Candidate> group;
  while (total < count && !candidates.empty()) {
    group.clear();
    do {
      group.push_back(candidates.top());
      candidates.pop();
    } while (!candidates.empty() && candidates.top().length >= kEqual * group.front().length);
    total += double(group.size());
    if (!(total <= count) || !(group.front().length > 0)) break;
    for (const Candidate& candidate : group) {
      ++parts[candidate.edge];
      candidates.push({lengths[candidate.edge] / (parts[candidate.edge] + 0.5), candidate.edge});
    }
  }
  return parts;
}

/// The parts of each edge of a contour, of which `most` may be made.
std::vector<double> edge_parts(const Contour& contour, const LinearExtrude& how, int slices,
                               double most) {
  const std::vector<double> one(contour.size(), 1);
  const auto by_count = [&](double count) {
    if (!(double(contour.size()) < count)) return one;
    return parts_by_count(longest_lengths(contour, how, slices), std::min(count, most));
  };
  if (how.segments) return by_count(std::trunc(*how.segments));
  const double fn = clamped_fn(how.fragments);
  if (fn > 0) return by_count(fn);
  const double around = std::ceil(360 / clamped_fa(how.fragments));
  if (!(double(contour.size()) < around)) return one;
  std::vector<double> parts =
      parts_by_size(longest_lengths(contour, how, slices), clamped_fs(how.fragments));
  return sum(parts) < around ? parts : by_count(around);
}

}  // namespace

bool is_curved(const LinearExtrude& how) {
  return how.twist_degrees != 0 || how.scale.x != how.scale.y;
}

int slice_count(const Polygons& polygons, const LinearExtrude& how, int most) {
  const double count = how.slices && std::isfinite(*how.slices) ? std::trunc(*how.slices)
                                                                : chosen_slices(polygons, how);
  return count >= most ? most : std::max(int(count), 1);
}

Polygons divided_outlines(const Polygons& polygons, const LinearExtrude& how, int slices,
                          double most) {
  if (!how.segments && !is_curved(how)) return polygons;
  Polygons result;
  for (const Contour& contour : polygons.contours)
    result.contours.push_back(divided(contour, edge_parts(contour, how, slices, most)));
  return result;
}

Vec2 slice_point(const LinearExtrude& how, double t, Vec2 bottom) {
  const double degrees = -how.twist_degrees * t;
  const double c = cos_degrees(degrees), s = sin_degrees(degrees);
  return {(1 - (1 - how.scale.x) * t) * (c * bottom.x - s * bottom.y),
          (1 - (1 - how.scale.y) * t) * (s * bottom.x + c * bottom.y)};
}

}  // namespace whittle

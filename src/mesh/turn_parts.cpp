#include "mesh/turn_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/box.h"

namespace whittle {
namespace {

double volume_of(const std::vector<Vec3>& points, const Corners& t, Vec3 origin) {
  return dot(points[t[0]] - origin, cross(points[t[1]] - origin, points[t[2]] - origin)) / 6;
}

/// The solid angle a triangle is seen at (van Oosterom and Strackee, The Solid Angle of a Plane
/// Triangle, 1983); none from a place on it, where only rounding says which side is seen.
double solid_angle(const std::vector<Vec3>& points, const Corners& t, Vec3 p) {
  const Vec3 a = points[t[0]] - p, b = points[t[1]] - p, c = points[t[2]] - p;
  const double la = length(a), lb = length(b), lc = length(c), lengths = la * lb * lc;
  const double sine = dot(a, cross(b, c)),
               cosine = lengths + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  constexpr double kOnIt = 1e-9;
  if (cosine <= 0 && std::fabs(sine) <= kOnIt * lengths) return 0;
  return 2 * std::atan2(sine, cosine);
}

/// A part that is closed.
struct Part {
  double volume = 0;
  Box box;
  std::vector<uint32_t> triangles;
};

double winding_of_others(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                         const std::vector<Part>& parts, size_t own, Vec3 p, size_t& budget) {
  double sum = 0;
  budget -= std::min(budget, 1 + parts.size() / 8);
  for (size_t k = 0; k < parts.size(); ++k) {
    if (k == own || !parts[k].box.contains(p)) continue;
    budget -= std::min(budget, parts[k].triangles.size());
    for (const uint32_t t : parts[k].triangles) sum += solid_angle(points, triangles[t], p);
  }
  return sum / (4 * std::numbers::pi);
}

/// How often the others go around a part. Where it touches one the number is not whole, so several
/// places are asked.
double winding_around(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                      const std::vector<Part>& parts, size_t own, size_t& budget) {
  constexpr size_t kPlaces = 8;
  const std::vector<uint32_t>& mine = parts[own].triangles;
  double best = 0, best_off = kInfinity;
  for (size_t i = 0; i < kPlaces && best_off > 0.01; ++i) {
    const Corners& t = triangles[mine[i * mine.size() / kPlaces]];
    const Vec3 p = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    const double winding = winding_of_others(points, triangles, parts, own, p, budget);
    const double off = std::fabs(winding - std::round(winding));
    if (off < best_off) best = winding, best_off = off;
  }
  return best;
}

}  // namespace

void turn_parts(const std::vector<Vec3>& points, std::vector<Corners>& triangles,
                const MeshParts& parts) {
  std::vector<uint32_t> number(parts.is_open.size(), 0);
  uint32_t count = 0;
  for (size_t i = 0; i < number.size(); ++i)
    if (!parts.is_open[i]) number[i] = count++;
  if (count == 0) return;
  std::vector<Part> closed(count);
  const Vec3 origin = points[triangles[0][0]];
  double all = 0;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (parts.is_open[parts.part_of[t]]) continue;
    Part& part = closed[number[parts.part_of[t]]];
    const double volume = volume_of(points, triangles[t], origin);
    part.volume += volume;
    all += volume;
    for (const uint32_t corner : triangles[t]) part.box.include(points[corner]);
    part.triangles.push_back(t);
  }
  size_t budget = 20'000'000;
  for (size_t i = 0; i < count; ++i) {
    bool is_turned = all < 0;
    if ((closed[i].volume < 0) != is_turned && budget > 0)
      if (std::fabs(winding_around(points, triangles, closed, i, budget)) < 0.5)
        is_turned = !is_turned;
    if (!is_turned) continue;
    for (const uint32_t t : closed[i].triangles) std::swap(triangles[t][1], triangles[t][2]);
  }
}

}  // namespace whittle

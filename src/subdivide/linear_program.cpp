#include "subdivide/linear_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace whittle {
namespace {

/// Of a constraint's coefficients (at most 1) what is rounding.
constexpr double kNoCoefficient = 1e-12;

/// a x + b y <= c.
struct Constraint2 {
  double a, b, c;
};
struct Point2 {
  double x, y;
};

/// The largest value that a one-dimensional program reaches: lo <= x <= hi.
struct Interval {
  double lo, hi;

  /// Adds k x <= c. False if that is impossible.
  bool add(double k, double c, double slack) {
    if (std::fabs(k) <= kNoCoefficient) return c >= -slack;
    if (k > 0)
      hi = std::min(hi, c / k);
    else
      lo = std::max(lo, c / k);
    return true;
  }
  double best(double objective) const {
    if (lo > hi) return (lo + hi) / 2;
    return objective >= 0 ? hi : lo;
  }
};

double corner(double objective, double half) {
  return objective >= 0 ? half : -half;
}

std::optional<Point2> farthest_point_2(Point2 objective, std::span<const Constraint2> constraints,
                                       Point2 half, double slack) {
  Point2 best{corner(objective.x, half.x), corner(objective.y, half.y)};
  for (size_t i = 0; i < constraints.size(); ++i) {
    const Constraint2& tight = constraints[i];
    if (tight.a * best.x + tight.b * best.y <= tight.c + slack) continue;
    const bool drop_x = std::fabs(tight.a) >= std::fabs(tight.b);
    const double pivot = drop_x ? tight.a : tight.b, other = drop_x ? tight.b : tight.a;
    if (std::fabs(pivot) <= kNoCoefficient) return std::nullopt;
    // On the line the dropped coordinate is (c - other t) / pivot, t the one that is kept.
    const double at0 = tight.c / pivot, slope = -other / pivot;
    const double dropped_half = drop_x ? half.x : half.y, kept_half = drop_x ? half.y : half.x;
    Interval t{-kept_half, kept_half};
    bool possible =
        t.add(slope, dropped_half - at0, slack) && t.add(-slope, dropped_half + at0, slack);
    for (size_t j = 0; possible && j < i; ++j) {
      const Constraint2& c = constraints[j];
      const double dropped = drop_x ? c.a : c.b, kept = drop_x ? c.b : c.a;
      possible = t.add(kept + dropped * slope, c.c - dropped * at0, slack);
    }
    if (!possible || t.lo > t.hi + slack) return std::nullopt;
    const double dropped_objective = drop_x ? objective.x : objective.y;
    const double kept_objective = drop_x ? objective.y : objective.x;
    const double kept = t.best(kept_objective + dropped_objective * slope);
    const double dropped = at0 + slope * kept;
    best = drop_x ? Point2{dropped, kept} : Point2{kept, dropped};
  }
  return best;
}

}  // namespace

std::optional<Vec3> farthest_point(Vec3 objective, std::span<const Constraint> constraints,
                                   Vec3 half) {
  const double slack = 1e-12 * max_component(half);
  Vec3 best{corner(objective.x, half.x), corner(objective.y, half.y), corner(objective.z, half.z)};
  std::vector<Constraint2> on_plane;
  for (size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& tight = constraints[i];
    if (dot(tight.n, best) <= tight.d + slack) continue;
    // The optimum now lies on this plane; there one coordinate, k, follows from the others, u and
    // v.
    const Vec3 size = abs(tight.n);
    const int k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const double at0 = tight.d / tight.n[k];
    const double slope_u = -tight.n[u] / tight.n[k], slope_v = -tight.n[v] / tight.n[k];
    on_plane.clear();
    on_plane.push_back({slope_u, slope_v, half[k] - at0});
    on_plane.push_back({-slope_u, -slope_v, half[k] + at0});
    for (size_t j = 0; j < i; ++j) {
      const Constraint& c = constraints[j];
      on_plane.push_back(
          {c.n[u] + c.n[k] * slope_u, c.n[v] + c.n[k] * slope_v, c.d - c.n[k] * at0});
    }
    const std::optional<Point2> there = farthest_point_2(
        {objective[u] + objective[k] * slope_u, objective[v] + objective[k] * slope_v}, on_plane,
        {half[u], half[v]}, slack);
    if (!there) return std::nullopt;
    best[u] = there->x, best[v] = there->y;
    best[k] = at0 + slope_u * there->x + slope_v * there->y;
  }
  return best;
}

}  // namespace whittle

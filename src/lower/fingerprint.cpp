#include "lower/fingerprint.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

using K = Kernels<double>;

/// Frobenius norm of the second-degree part.
double curvature(const K::Quadric& f) {
  return std::sqrt(dot(f.diag, f.diag) + 2 * dot(f.off, f.off));
}

// The values of f at three points in general position tell surfaces apart and hardly change
// between nearly equal ones. They are taken relative to the second degree: equal over a small
// primitive, two may part far away from it, but in those units by no more than in shape.
// asinh tames the growth of what is far off; the slack holds for walls that come within a few
// radii, and of others nothing is seen.
PointIndex::Point wall_point(const HalfSpace& h, double region) {
  static constexpr Vec3 kProbes[3] = {
      {0.413, -0.287, 0.619}, {-0.531, 0.347, 0.271}, {0.179, 0.683, -0.443}};
  const double unit = curvature(h.f) * region * region;
  PointIndex::Point point;
  for (size_t i = 0; i < 3; ++i)
    point[i] = std::asinh(K::quadric_value(h.f, kProbes[i] * region - h.center) / unit);
  return point;
}

PointIndex::Point ball_point(const HalfSpace& h, double region) {
  PointIndex::Point point;
  for (size_t i = 0; i < 3; ++i) point[i] = std::asinh(h.center[int(i)] / region);
  return point;
}

double wall_slack(const Reach& reach, double region) {
  const double size = std::min({reach.width, reach.radius, region});
  return size > 0 ? 16 * reach.tolerance / size : 0;
}

// Of two equal ellipsoids f of the one differs between opposite points p and q of the other by
// 2 (p - q).M d, d the way between the middles, and may differ by no more than the tolerance
// times the sum of the gradients there, 2 |M (p - q)|. With the three pairs on the axes of the
// other that bounds |d| by sqrt(3) times the tolerance times the ratio of the longest semi-axis
// to the shortest; sqrt(12) times the latter is above the width, and 1.2 times the outline's
// reach above the former.
double ball_slack(const Reach& reach, double region) {
  const double size = reach.width * region;
  return size > 0 ? 16 * reach.tolerance * reach.ball_reach / size : 0;
}

}  // namespace

PointIndex::Point fingerprint_point(const HalfSpace& h, bool is_ball, double region) {
  return is_ball ? ball_point(h, region) : wall_point(h, region);
}

double fingerprint_slack(const Reach& reach, double region) {
  return reach.ball_reach > 0 ? ball_slack(reach, region) : wall_slack(reach, region);
}

}  // namespace whittle

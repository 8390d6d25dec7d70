#include "trace/pixel_threshold.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// Between corners as Box numbers them.
struct Edge {
  int a, b;
};
constexpr Edge kEdges[12] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                             {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

bool is_met_by(const Box& box, const Ray& ray) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.lo[axis] || o > box.hi[axis]) return false;
      continue;
    }
    const double a = (box.lo[axis] - o) / d, b = (box.hi[axis] - o) / d;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

}  // namespace

PixelThreshold::PixelThreshold(const Camera& camera, double pixels)
    : camera_(camera),
      pixels_(pixels),
      half_width_(camera.half_height * camera.width / camera.height),
      half_height_(camera.half_height),
      pixels_per_unit_(camera.height / (2 * camera.half_height)),
      // From one corner to another there are three edges at most.
      is_coarse_(!(3 * pixels < 0.5 * std::hypot(camera.width, camera.height))) {}

PixelThreshold::Corners PixelThreshold::corners_of(const Box& box) const {
  const Vec3 ends[2] = {box.lo - camera_.eye, box.hi - camera_.eye};
  Corners corners;
  const auto fill = [&](Vec3 along, double* to) {
    double part[3][2];
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) part[axis][end] = ends[end][axis] * along[axis];
    for (int i = 0; i < 8; ++i) to[i] = part[0][i & 1] + part[1][i >> 1 & 1] + part[2][i >> 2];
  };
  fill(camera_.right, corners.x);
  fill(camera_.up, corners.y);
  fill(camera_.forward, corners.z);
  return corners;
}

/// Whether no corner is behind the eye or beside the screen.
bool PixelThreshold::shows_all_of(const Corners& c) const {
  double least_ahead = kInfinity, least_inside = kInfinity;
  for (int i = 0; i < 8; ++i) {
    const double reach = camera_.orthographic ? 1 : c.z[i];
    least_ahead = std::min(least_ahead, reach);
    least_inside = std::min(least_inside, half_width_ * reach - std::fabs(c.x[i]));
    least_inside = std::min(least_inside, half_height_ * reach - std::fabs(c.y[i]));
  }
  return least_ahead > 0 && least_inside >= 0;
}

/// Precondition: shows_all_of() them.
bool PixelThreshold::edges_are_short(const Corners& c) const {
  double x[8], y[8];
  for (int i = 0; i < 8; ++i) {
    const double scale = pixels_per_unit_ / (camera_.orthographic ? 1 : c.z[i]);
    x[i] = c.x[i] * scale;
    y[i] = c.y[i] * scale;
  }
  const double most = pixels_ * pixels_;
  return std::ranges::all_of(kEdges, [&](const Edge& edge) {
    const double dx = x[edge.a] - x[edge.b], dy = y[edge.a] - y[edge.b];
    return dx * dx + dy * dy < most;
  });
}

/// How far inside of each of the four sides a point is, in any unit. Between the sides of a
/// perspective view z is not negative.
double PixelThreshold::inside(int side, Vec3 p) const {
  const double reach = camera_.orthographic ? 1 : p.z;
  const double along = side < 2 ? p.x : p.y;
  const double limit = (side < 2 ? half_width_ : half_height_) * reach;
  return side % 2 == 0 ? limit - along : limit + along;
}

double PixelThreshold::distance_in_pixels(Vec3 a, Vec3 b) const {
  if (!camera_.orthographic) a = a / a.z, b = b / b.z;
  return std::hypot(a.x - b.x, a.y - b.y) * pixels_per_unit_;
}

/// The length of the visible part of an edge. An edge through the eye gives infinity or NaN.
double PixelThreshold::visible_length(Vec3 a, Vec3 b) const {
  double t0 = 0, t1 = 1;
  for (int side = 0; side < 4; ++side) {
    const double at_a = inside(side, a), at_b = inside(side, b);
    if (at_a < 0 && at_b < 0) return 0;
    const double t = at_a / (at_a - at_b);
    if (at_a < 0) t0 = std::max(t0, t);
    if (at_b < 0) t1 = std::min(t1, t);
  }
  if (t0 >= t1) return 0;
  return distance_in_pixels(a + (b - a) * t0, a + (b - a) * t1);
}

/// What a box covers of the screen is convex. So if all of its visible edges are short, it is
/// either small itself, or leaves out no more of the screen than a little near one corner.
bool PixelThreshold::covers_screen(const Box& box) const {
  const double w = camera_.width, h = camera_.height;
  if (!is_met_by(box, camera_.ray(w / 2, h / 2))) return false;
  const bool some_corner = is_met_by(box, camera_.ray(0, 0)) || is_met_by(box, camera_.ray(w, 0)) ||
                           is_met_by(box, camera_.ray(0, h)) || is_met_by(box, camera_.ray(w, h));
  return some_corner;
}

bool PixelThreshold::operator()(const Box& box) const {
  const Corners c = corners_of(box);
  if (!is_coarse_ && shows_all_of(c)) return edges_are_short(c);
  const auto corner = [&](int i) { return Vec3{c.x[i], c.y[i], c.z[i]}; };
  // Written so that a NaN is not small.
  const bool all_short = std::ranges::all_of(kEdges, [&](const Edge& edge) {
    return visible_length(corner(edge.a), corner(edge.b)) < pixels_;
  });
  return all_short && !covers_screen(box);
}

}  // namespace whittle

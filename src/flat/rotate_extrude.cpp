#include <algorithm>
#include <cmath>

#include "base/degrees.h"
#include "flat/extrude.h"
#include "flat/mesh_builder.h"
#include "flat/sides.h"
#include "flat/triangulation.h"

namespace whittle {

namespace {

struct Turn {
  double start_degrees, angle_degrees;
  int steps;
  bool is_full;

  double degrees(double step) const { return start_degrees + angle_degrees * step / steps; }
};

class RotateExtruder {
 public:
  RotateExtruder(const WeldedPolygons& profile, const Turn& turn) : profile_(profile), turn_(turn) {
    double least = 0;
    for (const Vec2 p : profile.points) least = std::min(least, p.x);
    // A profile on the left and a turn to the right each turn the body inside out.
    flip_ = (least < 0) != (turn.angle_degrees < 0);
  }

  TriangleMesh run() && {
    rings_.reserve(size_t(turn_.steps) + 1);
    for (int j = 0; j < turn_.steps + (turn_.is_full ? 0 : 1); ++j) rings_.push_back(ring(j));
    if (turn_.is_full) rings_.push_back(rings_.front());
    const std::vector<ContourSide> all = sides(profile_);
    for (int j = 0; j < turn_.steps; ++j) add_step(all, j);
    if (!turn_.is_full) add_caps();
    return std::move(builder_).finish();
  }

 private:
  using Ring = std::vector<uint32_t>;

  Ring ring(int j) {
    const double c = cos_degrees(turn_.degrees(j)), s = sin_degrees(turn_.degrees(j));
    Ring numbers;
    numbers.reserve(profile_.points.size());
    for (const Vec2 p : profile_.points) numbers.push_back(builder_.point({p.x * c, p.x * s, p.y}));
    return numbers;
  }

  void triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t facet) {
    if (flip_)
      builder_.triangle(a, c, b, facet);
    else
      builder_.triangle(a, b, c, facet);
  }

  uint32_t facet(Plane plane) { return builder_.facet(flip_ ? Plane{-plane.n, -plane.d} : plane); }

  void add_step(const std::vector<ContourSide>& all, int j) {
    const Ring &here = rings_[size_t(j)], &there = rings_[size_t(j) + 1];
    const double middle = turn_.degrees(j + 0.5);
    const double c = cos_degrees(middle), s = sin_degrees(middle);
    const double apothem = cos_degrees(turn_.angle_degrees / turn_.steps / 2);
    for (const ContourSide& side : all) {
      const uint32_t a = here[side.from], b = here[side.to];
      // On the axis nothing is swept.
      if (a == there[side.from] && b == there[side.to]) continue;
      const uint32_t number = builder_.facet(plane(side, c, s, apothem));
      triangle(a, there[side.from], there[side.to], number);
      triangle(a, there[side.to], b, number);
    }
  }

  /// Of the trapezoid that a side sweeps in a step with the given middle, outward whichever side of
  /// the axis it is on.
  static Plane plane(const ContourSide& side, double c, double s, double apothem) {
    const Vec2 from = side.line_from, along = side.line_to - from;
    if (along.y == 0) {
      const double z = along.x > 0 ? -1 : 1;
      return {{0, 0, z}, z * from.y};
    }
    const double across = along.y, up = -apothem * along.x, size = std::hypot(across, up);
    return {{across / size * c, across / size * s, up / size},
            across / size * (from.x * apothem) + up / size * from.y};
  }

  void add_caps() {
    const double first = turn_.degrees(0), last = turn_.degrees(turn_.steps);
    const double sign = flip_ ? -1 : 1;
    const uint32_t start =
        builder_.facet({Vec3{sin_degrees(first), -cos_degrees(first), 0} * sign, 0});
    const uint32_t end = builder_.facet({Vec3{-sin_degrees(last), cos_degrees(last), 0} * sign, 0});
    for (const auto& [a, b, c] : triangulate(profile_)) {
      triangle(rings_.front()[a], rings_.front()[b], rings_.front()[c], start);
      triangle(rings_.back()[a], rings_.back()[c], rings_.back()[b], end);
    }
  }

  const WeldedPolygons& profile_;
  const Turn turn_;
  bool flip_ = false;
  MeshBuilder builder_;
  std::vector<Ring> rings_;
};

}  // namespace

bool crosses_axis(const Polygons& polygons) {
  bool left = false, right = false;
  for (const Contour& contour : polygons.contours)
    for (const Vec2 corner : contour) left |= corner.x<0, right |= corner.x> 0;
  return left && right;
}

TriangleMesh rotate_extrude(const Polygons& polygons, const RotateExtrude& how, int facets) {
  if (!std::isfinite(how.angle_degrees) || !std::isfinite(how.start_degrees) ||
      how.angle_degrees == 0)
    return {};
  const WeldedPolygons profile = weld(polygons);
  if (profile.contours.empty()) return {};
  const bool is_full = std::abs(how.angle_degrees) >= 360;
  double angle = is_full ? 360 : how.angle_degrees;
  const double most = std::max(kMaxSides / double(profile.points.size()), 3.0);
  const double full = std::clamp(double(facets), is_full ? 3.0 : 1.0, most);
  const int steps = std::max(int(std::ceil(full * std::abs(angle) / 360)), 1);
  // One step of more than half a turn comes to the same place as a shorter one the other way.
  if (steps == 1 && std::abs(angle) > 180) angle -= std::copysign(360, angle);
  return RotateExtruder(profile, {how.start_degrees, angle, steps, is_full}).run();
}

}  // namespace whittle

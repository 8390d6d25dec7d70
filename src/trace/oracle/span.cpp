// Each surface is met in the coordinates of the primitive it came from. The direction is carried
// over without normalising, so that t is the same number in both spaces. The origin is first moved
// along the ray to where it passes closest: what is then squared and subtracted is of the
// primitive's own size, and a distant eye costs no digits. Roots of quadratics by the form that
// never subtracts nearly equal numbers (Press et al., Numerical Recipes, 5.6).
#include "trace/oracle/span.h"

#include <algorithm>
#include <cmath>

namespace whittle {

namespace {

struct Line {
  Vec3 o, d;
  Vec3 at(double t) const { return o + d * t; }
};

/// Parameter of the point of the line that is closest to p.
double closest_approach(const Line& line, Vec3 p) {
  return dot(p - line.o, line.d) / dot(line.d, line.d);
}

constexpr Span kNoSpan = {kInfinity, -kInfinity, {}, {}};

Span plane_span(const Plane& plane, const Line& line) {
  const double room = plane.d - dot(plane.n, line.o), speed = dot(plane.n, line.d);
  if (speed == 0) return room < 0 ? kNoSpan : Span{};
  const double t = room / speed;
  return speed > 0 ? Span{-kInfinity, t, {}, plane.n} : Span{t, kInfinity, plane.n, {}};
}

/// Keeps of `span` what is in `other` too; where ends are equal, its own.
void clip(Span& span, const Span& other) {
  if (other.t0 > span.t0) span.t0 = other.t0, span.n0 = other.n0;
  if (other.t1 < span.t1) span.t1 = other.t1, span.n1 = other.n1;
}

/// The two real roots, in order, of a t^2 + 2 b t + c, given b^2 - a c >= 0. With a = 0 one of them
/// is infinite.
struct Roots {
  double low, high;
};
Roots solve(double a, double b, double c, double discriminant) {
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double one = q / a, other = q != 0 ? c / q : one;
  return {std::min(one, other), std::max(one, other)};
}

Span sphere_span(double radius, const Line& line) {
  const double a = dot(line.d, line.d), b = dot(line.o, line.d);
  const double c = dot(line.o, line.o) - radius * radius;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return kNoSpan;
  const auto [t0, t1] = solve(a, b, c, discriminant);
  return {t0, t1, line.at(t0), line.at(t1)};
}

/// One nappe of a cone, which is convex.
Span cone_span(const Surface& s, bool other_nappe, const Line& given) {
  // From where the ray passes the axis, if that is next to the primitive: a long thin cylinder is
  // small there, however far its middle is. Another primitive's wall may go on beyond this one's
  // ends, which a ray square to the axis meets far away or never: then not from there.
  const double across = given.d.x * given.d.x + given.d.y * given.d.y;
  double moved = across > 0 ? -(given.o.x * given.d.x + given.o.y * given.d.y) / across : 0;
  if (given.d.z != 0) {
    const double t0 = (s.z0 - given.o.z) / given.d.z, t1 = (s.z1 - given.o.z) / given.d.z;
    const double between = std::clamp(moved, std::min(t0, t1), std::max(t0, t1));
    if (std::fabs(between) < std::fabs(moved)) moved = between;
  }
  const Line line = {given.at(moved), given.d};
  const Vec3 o = line.o, d = line.d;
  const double nappe = other_nappe ? -1 : 1;
  const double slope = nappe * s.slope;
  const double radius = nappe * s.radius + slope * (o.z - s.z0), growth = slope * d.z;

  const double a = across - growth * growth;
  const double b = o.x * d.x + o.y * d.y - radius * growth;
  const double c = o.x * o.x + o.y * o.y - radius * radius;
  // b^2 - a c, without the radius to the fourth power: of a cone that is flat, and so much wider at
  // `o` than where it is met, nothing would be left of the difference.
  const double u = radius * d.x - growth * o.x, v = radius * d.y - growth * o.y;
  const double w = o.x * d.y - o.y * d.x;
  const double discriminant = u * u + v * v - w * w;
  double t0 = -kInfinity, t1 = kInfinity;
  if (a > 0) {
    // The ray is flatter than the cone: it crosses one nappe, or none.
    if (!(discriminant > 0)) return kNoSpan;
    const Roots roots = solve(a, b, c, discriminant);
    t0 = roots.low, t1 = roots.high;
    if (radius + growth * (t0 + t1) / 2 < 0) return kNoSpan;
  } else if (a < 0) {
    // Steeper: it crosses both, and is inside ours from its root on, where the cone grows. The
    // discriminant cannot be negative but by rounding.
    const Roots roots = solve(a, b, c, std::max(discriminant, 0.0));
    (growth > 0 ? t0 : t1) = growth > 0 ? roots.high : roots.low;
  } else if (growth == 0) {
    // Along the axis of a cylinder.
    if (c >= 0) return kNoSpan;
  } else {
    // Along a line of the cone: one crossing, and our nappe is where the cone grows.
    if (b == 0 || (b < 0) != (growth > 0)) return kNoSpan;
    (b < 0 ? t0 : t1) = -c / (2 * b);
  }

  const auto normal = [&](double t) {
    const Vec3 p = line.at(t);
    const double r = std::hypot(p.x, p.y);
    return r > 0 ? Vec3{p.x / r, p.y / r, -slope} : Vec3{0, 0, slope > 0 ? -1.0 : 1.0};
  };
  Span span = {t0 + moved, t1 + moved, {}, {}};
  if (std::isfinite(t0)) span.n0 = normal(t0);
  if (std::isfinite(t1)) span.n1 = normal(t1);
  return span;
}

Span face_span(const Surface& s, bool other_side, const Line& line) {
  if (s.kind == Surface::Kind::kSphere) return sphere_span(s.radius, line);
  if (s.kind == Surface::Kind::kCone) return cone_span(s, other_side, line);
  return plane_span(other_side ? Plane{-s.plane.n, -s.plane.d} : s.plane, line);
}

}  // namespace

Span ray_span(const Surfaces& surfaces, size_t solid, Vec3 origin, Vec3 direction) {
  Span span;
  const Surfaces::Frame* frame = nullptr;
  double moved = 0;
  Line line;
  for (const SurfaceFace& face : surfaces.faces_of(solid)) {
    const Surface& surface = surfaces.all[face.surface];
    if (const auto* its = &surfaces.frames[surface.frame]; its != frame) {
      frame = its;
      const Line far_line = {frame->object_from_world.point(origin),
                             frame->object_from_world.vector(direction)};
      moved = closest_approach(far_line, frame->anchor);
      line = {far_line.at(moved), far_line.d};
    }
    Span part = face_span(surface, face.other_side, line);
    if (part.is_empty()) return kNoSpan;
    part.t0 += moved, part.t1 += moved;
    part.n0 = frame->object_from_world.transposed_vector(part.n0);
    part.n1 = frame->object_from_world.transposed_vector(part.n1);
    clip(span, part);
    if (span.is_empty()) return kNoSpan;
  }
  span.n0 = normalize(span.n0);
  span.n1 = normalize(span.n1);
  return span;
}

PlaneCrossing plane_crossing(const Surfaces& surfaces, const SurfaceFace& face, Vec3 origin,
                             Vec3 direction) {
  const Surface& surface = surfaces.all[face.surface];
  const Surfaces::Frame& frame = surfaces.frames[surface.frame];
  const Line far_line = {frame.object_from_world.point(origin),
                         frame.object_from_world.vector(direction)};
  const double moved = closest_approach(far_line, frame.anchor);
  const Span span = face_span(surface, face.other_side, {far_line.at(moved), far_line.d});
  const bool enters = std::isfinite(span.t0);
  if (span.is_empty() || (!enters && !std::isfinite(span.t1))) return {};
  return {(enters ? span.t0 : span.t1) + moved,
          normalize(frame.object_from_world.transposed_vector(enters ? span.n0 : span.n1))};
}

Span ray_span(const Box& box, Vec3 origin, Vec3 direction) {
  Span span;
  const Line line = {origin, direction};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 n;
    n[axis] = 1;
    clip(span, plane_span({n, box.hi[axis]}, line));
    clip(span, plane_span({-n, -box.lo[axis]}, line));
  }
  return span;
}

}  // namespace whittle

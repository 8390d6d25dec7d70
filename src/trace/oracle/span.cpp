// Each primitive is met in its own coordinates. The direction is carried over without normalising,
// so that t is the same number in both spaces. The origin is first moved along the ray to where it
// passes closest: what is then squared and subtracted is of the primitive's own size, and a distant
// eye costs no digits. Roots of quadratics by the form that never subtracts nearly equal numbers
// (Press et al., Numerical Recipes, 5.6).
#include "trace/oracle/span.h"

#include <algorithm>
#include <cmath>

#include "model/facets.h"

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

void clip(Span& span, const Line& line, const Plane& plane) {
  const double room = plane.d - dot(plane.n, line.o), speed = dot(plane.n, line.d);
  if (speed == 0) {
    if (room < 0) span.t1 = -kInfinity, span.t0 = kInfinity;
    return;
  }
  const double t = room / speed;
  if (speed > 0 && t < span.t1) span.t1 = t, span.n1 = plane.n;
  if (speed < 0 && t > span.t0) span.t0 = t, span.n0 = plane.n;
}

constexpr Span kNoSpan = {kInfinity, -kInfinity, {}, {}};

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

Span sphere_span(const Sphere& s, const Line& line) {
  const double a = dot(line.d, line.d), b = dot(line.o, line.d);
  const double c = dot(line.o, line.o) - s.r * s.r;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return kNoSpan;
  const auto [t0, t1] = solve(a, b, c, discriminant);
  return {t0, t1, line.at(t0), line.at(t1)};
}

/// The frustum about the z axis: two caps, and one nappe of the cone x^2 + y^2 <= r(z)^2 with
/// r(z) = r1 + slope (z - z0).
Span cylinder_span(const Cylinder& s, const Line& given) {
  const double z0 = s.center ? -s.h / 2 : 0, z1 = z0 + s.h;
  const double slope = (s.r2 - s.r1) / s.h;
  Span caps;
  clip(caps, given, {{0, 0, -1}, -z0});
  clip(caps, given, {{0, 0, 1}, z1});
  if (caps.is_empty()) return kNoSpan;

  // From where the ray passes the axis, if that is between the caps: a long thin cylinder is small
  // there, however far its middle is.
  const double across = given.d.x * given.d.x + given.d.y * given.d.y;
  const double to_axis = -(given.o.x * given.d.x + given.o.y * given.d.y) / across;
  const double moved = across > 0 ? std::clamp(to_axis, caps.t0, caps.t1) : 0;
  const Line line = {given.at(moved), given.d};
  const Vec3 o = line.o, d = line.d;
  const double radius = s.r1 + slope * (o.z - z0), growth = slope * d.z;

  const double a = across - growth * growth;
  const double b = o.x * d.x + o.y * d.y - radius * growth;
  const double c = o.x * o.x + o.y * o.y - radius * radius;
  const double discriminant = b * b - a * c;
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

  const auto side_normal = [&](double t) {
    const Vec3 p = line.at(t);
    const double r = std::hypot(p.x, p.y);
    return r > 0 ? Vec3{p.x / r, p.y / r, -slope} : Vec3{0, 0, slope > 0 ? -1.0 : 1.0};
  };
  Span span = {t0, t1, {}, {}};
  if (std::isfinite(t0)) span.n0 = side_normal(t0);
  if (std::isfinite(t1)) span.n1 = side_normal(t1);
  // An end that is a point has no cap.
  if (s.r1 > 0) clip(span, line, {{0, 0, -1}, -z0});
  if (s.r2 > 0) clip(span, line, {{0, 0, 1}, z1});
  span.t0 += moved, span.t1 += moved;
  return span;
}

Span cube_span(const Cube& s, const Line& line) {
  const Vec3 lo = s.center ? s.size * -0.5 : Vec3{}, hi = lo + s.size;
  return ray_span(Box{lo, hi}, line.o, line.d);
}

Span planes_span(const std::vector<Plane>& planes, const Line& line) {
  Span span;
  for (const Plane& plane : planes) clip(span, line, plane);
  return span;
}

}  // namespace

ConvexSolid make_convex_solid(const Model& model, const Instance& instance) {
  const Shape& shape = model.primitives[instance.primitive].shape;
  ConvexSolid solid{.shape = &shape,
                    .planes = {},
                    .anchor = {},
                    .object_from_world = inverse(instance.world_from_object)};
  if (const auto* s = std::get_if<Cube>(&shape)) {
    if (!s->center) solid.anchor = s->size * 0.5;
  } else if (is_flat(shape)) {
    solid.planes = facet_planes(shape);
    Box box;
    for (const Vec3 p : facet_vertices(shape)) box.include(p);
    solid.anchor = box.is_empty() ? solid.planes[0].n * solid.planes[0].d : box.center();
  } else if (const auto* c = std::get_if<Cylinder>(&shape)) {
    if (!c->center) solid.anchor = {0, 0, c->h / 2};
  }
  return solid;
}

Span ray_span(const ConvexSolid& solid, Vec3 origin, Vec3 direction) {
  const Line far_line = {solid.object_from_world.point(origin),
                         solid.object_from_world.vector(direction)};
  const double moved = closest_approach(far_line, solid.anchor);
  const Line line = {far_line.at(moved), far_line.d};
  Span span;
  if (const auto* cube = std::get_if<Cube>(solid.shape))
    span = cube_span(*cube, line);
  else if (!solid.planes.empty())
    span = planes_span(solid.planes, line);
  else if (const auto* sphere = std::get_if<Sphere>(solid.shape))
    span = sphere_span(*sphere, line);
  else
    span = cylinder_span(std::get<Cylinder>(*solid.shape), line);
  if (span.is_empty()) return kNoSpan;
  span.t0 += moved, span.t1 += moved;
  span.n0 = normalize(solid.object_from_world.transposed_vector(span.n0));
  span.n1 = normalize(solid.object_from_world.transposed_vector(span.n1));
  return span;
}

Span ray_span(const Box& box, Vec3 origin, Vec3 direction) {
  Span span;
  const Line line = {origin, direction};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 n;
    n[axis] = 1;
    clip(span, line, {n, box.hi[axis]});
    clip(span, line, {-n, -box.lo[axis]});
  }
  return span;
}

}  // namespace whittle

#include "trace/oracle/span.h"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "shape/build_planes.h"
#include "shape/extent.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// Positive outside, negative inside, by definition of the shape; in its own coordinates.
double implicit(const Shape& shape, Vec3 p) {
  if (const auto* s = std::get_if<Sphere>(&shape); s && s->facets == 0) return length(p) - s->r;
  if (const auto* s = std::get_if<Cylinder>(&shape); s && s->facets == 0) {
    const double z0 = s->center ? -s->h / 2 : 0;
    const double r = s->r1 + (s->r2 - s->r1) * (p.z - z0) / s->h;
    return std::max({z0 - p.z, p.z - z0 - s->h, std::hypot(p.x, p.y) - r});
  }
  double most = -kInfinity;
  for (const Plane& plane : facet_planes(shape)) most = std::max(most, dot(plane.n, p) - plane.d);
  return most;
}

double number(int lo, int hi) {
  return *rc::gen::inRange(lo * 1000, hi * 1000) / 1000.0;
}
Vec3 vector(int reach) {
  return {number(-reach, reach), number(-reach, reach), number(-reach, reach)};
}

Shape any_shape() {
  const int facets = *rc::gen::element(0, 0, 3, 8);
  const bool center = *rc::gen::arbitrary<bool>();
  const double r = number(1, 4);
  switch (*rc::gen::inRange(0, 7)) {
    case 0:
      return Sphere{.r = r, .facets = facets};
    case 1:
      return Cylinder{.h = number(1, 6), .r1 = r, .r2 = r, .center = center, .facets = facets};
    case 2:
      return Cylinder{.h = number(1, 6), .r1 = r, .r2 = 0, .center = center, .facets = facets};
    case 3:
      return Cylinder{.h = number(1, 6), .r1 = 0, .r2 = r, .center = center, .facets = facets};
    case 4:
      return Cylinder{
          .h = number(1, 6), .r1 = r, .r2 = number(1, 4), .center = center, .facets = facets};
    case 5: {
      // A corner of space cut off beyond (1, 1, 1) / 3 at least.
      Polyhedron p{.points = {{0, 0, 0}, {number(1, 4), 0, 0}, {0, number(1, 4), 0}, {0, 0, r}},
                   .faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
                   .planes = {}};
      RC_ASSERT(build_planes(p).refusal == "");
      return p;
    }
    default:
      return Cube{.size = {number(1, 6), number(1, 6), number(1, 6)}, .center = center};
  }
}

/// A random instance of a random shape, as a model.
struct Placed {
  Model model;
  Instance instance;

  void set(Shape shape) {
    Node leaf;
    leaf.kind = NodeKind::kPrimitive;
    leaf.end = 2;
    model.nodes = {Node{}, leaf};
    model.nodes[0].end = 2;
    model.primitives.push_back({std::move(shape), 1});
    instance.node = 1;
  }
  const Shape& shape() const { return model.primitives[0].shape; }
  Surfaces surfaces() const { return name_surfaces(model, std::span(&instance, 1)); }
  /// A point well inside, own coordinates.
  Vec3 middle() const {
    if (std::holds_alternative<Polyhedron>(shape())) return {0.2, 0.2, 0.2};
    return extent(shape(), Affine{}).center;
  }
};

Placed any_placed() {
  Placed placed;
  placed.set(any_shape());
  Affine& map = placed.instance.world_from_object;
  // The diagonal outweighs the rest: never singular, mirrored as often as not.
  for (int i = 0; i < 3; ++i) {
    map.row[i] = vector(1) * 0.4;
    map.row[i][i] = number(1, 3) * *rc::gen::element(-1, 1);
  }
  map.translation = vector(5);
  return placed;
}

TEST(RaySpan, EndsOnTheSurfaceAndIsInsideBetween) {
  EXPECT_TRUE(rc::check([] {
    const Placed placed = any_placed();
    const Surfaces surfaces = placed.surfaces();
    const Affine object_from_world = inverse(placed.instance.world_from_object);
    // Aimed at the solid, from far off now and then.
    const Vec3 target = placed.instance.world_from_object.point(placed.middle() + vector(3));
    const Vec3 d = normalize(vector(1) + Vec3{0, 0, 1.5});
    const Vec3 origin = target - d * *rc::gen::element(0.0, 10.0, 1e6);
    const auto value = [&](double t) {
      return implicit(placed.shape(), object_from_world.point(origin + d * t));
    };
    const Span span = ray_span(surfaces, 0, origin, d);
    const double noise = 1e-8 * (1 + length(origin) * 1e-5);
    if (span.is_empty()) {
      // Then no point of the ray is properly inside.
      const double middle = dot(target - origin, d);
      for (int i = -400; i <= 400; ++i) RC_ASSERT(value(middle + 0.1 * i) > -noise);
      return;
    }
    RC_ASSERT(std::fabs(value(span.t0)) < noise * 100);
    RC_ASSERT(std::fabs(value(span.t1)) < noise * 100);
    for (const double f : {0.1, 0.5, 0.9})
      RC_ASSERT(value(span.t0 + f * (span.t1 - span.t0)) < noise);
    const double step = 1e-3 * (span.t1 - span.t0) + 1e-3;
    RC_ASSERT(value(span.t0 - step) > -noise);
    RC_ASSERT(value(span.t1 + step) > -noise);
  }));
}

TEST(RaySpan, NormalsPointOutward) {
  EXPECT_TRUE(rc::check([] {
    const Placed placed = any_placed();
    const Surfaces surfaces = placed.surfaces();
    const Vec3 target = placed.instance.world_from_object.point(placed.middle() + vector(1));
    const Vec3 d = normalize(vector(1) + Vec3{0, 0, 1.5}), origin = target - d * 10.0;
    const Span span = ray_span(surfaces, 0, origin, d);
    RC_CLASSIFY(span.is_empty(), "miss");
    if (span.is_empty()) return;
    RC_ASSERT(std::fabs(length(span.n0) - 1) < 1e-12);
    RC_ASSERT(dot(span.n0, d) <= 1e-12);
    RC_ASSERT(dot(span.n1, d) >= -1e-12);
    // By the definition of a normal of a convex solid: every other point of it is behind.
    const Vec3 p0 = origin + d * span.t0, p1 = origin + d * span.t1;
    const Vec3 inside = placed.instance.world_from_object.point(placed.middle());
    RC_ASSERT(dot(inside - p0, span.n0) <= 1e-6);
    RC_ASSERT(dot(inside - p1, span.n1) <= 1e-6);
  }));
}

Span span_of(Shape shape, Vec3 origin, Vec3 direction) {
  Placed placed;
  placed.set(std::move(shape));
  return ray_span(placed.surfaces(), 0, origin, direction);
}

TEST(RaySpan, TouchingIsNotInside) {
  EXPECT_TRUE(span_of(Sphere{.r = 1}, {1, -5, 0}, {0, 1, 0}).is_empty());
  EXPECT_TRUE(span_of(Cylinder{}, {1, 0, -5}, {0, 0, 1}).is_empty());
  EXPECT_TRUE(span_of(Cylinder{.h = 1, .r1 = 1, .r2 = 0}, {-5, 0, 1}, {1, 0, 0}).is_empty());
}

TEST(RaySpan, ThroughTheApexOfACone) {
  const Cylinder cone{.h = 2, .r1 = 1, .r2 = 0};
  const Span down = span_of(cone, {0, 0, 5}, {0, 0, -1});
  EXPECT_DOUBLE_EQ(down.t0, 3);
  EXPECT_DOUBLE_EQ(down.t1, 5);
  EXPECT_EQ(down.n0, (Vec3{0, 0, 1}));
  const Span slanted = span_of(cone, {-0.25, 0, 3}, {0.25, 0, -1});
  EXPECT_DOUBLE_EQ(slanted.t0, 1);
  EXPECT_DOUBLE_EQ(slanted.t1, 3);
}

TEST(RaySpan, AlongALineOfTheCone) {
  // Parallel to the generator x = 1 - z / 2, half a unit nearer to the axis.
  const Span span = span_of(Cylinder{.h = 2, .r1 = 1, .r2 = 0}, {0.5, 0, 0}, {-0.5, 0, 1});
  EXPECT_DOUBLE_EQ(span.t0, 0);
  EXPECT_DOUBLE_EQ(span.t1, 1.5);
  // As far outside it: what this line would enter is the other nappe.
  EXPECT_TRUE(span_of(Cylinder{.h = 2, .r1 = 1, .r2 = 0}, {1.5, 0, 0}, {-0.5, 0, 1}).is_empty());
}

// A wall that goes on as another cylinder's, seen square to the axis but for rounding: where the
// ray meets the first cylinder's height is far away, and nothing may be taken from there.
TEST(RaySpan, OfAWallBeyondTheOneItIs) {
  Placed placed;
  placed.set(Cylinder{.h = 1, .r1 = 2, .r2 = 2, .center = false, .facets = 0});
  std::vector<Instance> instances(2, placed.instance);
  instances[1].world_from_object.translation = {0, 0, 3};
  const Surfaces surfaces = name_surfaces(placed.model, instances);
  ASSERT_EQ(surfaces.faces_of(1)[0].surface, surfaces.faces_of(0)[0].surface);
  const Span span = ray_span(surfaces, 1, {-5, 0, 3.5}, {1, 0, 1e-17});
  EXPECT_DOUBLE_EQ(span.t0, 3);
  EXPECT_DOUBLE_EQ(span.t1, 7);
}

// A revolution has such films where two corners of its profile are at one height but for rounding.
TEST(RaySpan, BesideAConeThatIsAllButAPlane) {
  const Cylinder film{.h = 4.6e-10, .r1 = 1.73, .r2 = 1.15};
  const Vec3 d = normalize(Vec3{-0.74, 0.63, -0.23});
  for (const double x : {-330.0, -1.8, 0.0, 1.1, 1.8, 330.0}) {
    SCOPED_TRACE(x);
    const Vec3 met = {x, -0.75 * x, 0};
    const bool hits = length(met) < 1.73;
    EXPECT_EQ(span_of(film, met - d * 750.0, d).is_empty(), !hits);
    EXPECT_EQ(span_of(film, met + d * 750.0, -d).is_empty(), !hits);
  }
}

TEST(RaySpan, HalfspaceIsHalfALine) {
  const Span into = span_of(Halfspace{.n = {0, 0, 2}, .d = 2}, {0, 0, 5}, {0, 0, -1});
  EXPECT_EQ(into.t0, 4);
  EXPECT_EQ(into.t1, kInfinity);
  const Span beside = span_of(Halfspace{.n = {0, 0, 2}, .d = 2}, {0, 0, 5}, {1, 0, 0});
  EXPECT_TRUE(beside.is_empty());
  const Span below = span_of(Halfspace{.n = {0, 0, 2}, .d = 2}, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(below.t0, -kInfinity);
  EXPECT_EQ(below.t1, kInfinity);
}

}  // namespace
}  // namespace whittle

#include "flat/extrude.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <limits>
#include <numbers>
#include <set>

#include "flat/polygons_for_test.h"

namespace whittle {
namespace {

Polygons frame() {
  Polygons polygons = box(-5, -5, 5, 5);
  polygons.contours.push_back({{-2, -2}, {-2, 2}, {2, 2}, {2, -2}});
  return polygons;
}

LinearExtrude of_height(double height) {
  LinearExtrude how;
  how.height = height;
  return how;
}

LinearExtrude twisted(double degrees, double scale_x, double scale_y, double slices) {
  LinearExtrude how = of_height(10);
  how.twist_degrees = degrees;
  how.scale = {scale_x, scale_y};
  if (slices > 0) how.slices = slices;
  how.segments = 0;
  return how;
}

/// Corners lie on their facets, and facets look the way their triangles do.
void expect_sound(const TriangleMesh& mesh, double size) {
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_LE(mesh.rise, 1e-9 * size);
  for (const auto& [corners, facet] : mesh.triangles) {
    const Plane& plane = mesh.facets[facet];
    EXPECT_NEAR(length(plane.n), 1, 1e-12);
    const Vec3 a = mesh.points[corners[0]];
    const Vec3 across = cross(mesh.points[corners[1]] - a, mesh.points[corners[2]] - a);
    EXPECT_GE(dot(across, plane.n), -1e-9 * size * size);
    for (const uint32_t corner : corners)
      EXPECT_LE(std::abs(dot(plane.n, mesh.points[corner]) - plane.d), mesh.rise);
  }
}

size_t levels(const TriangleMesh& mesh) {
  std::set<double> heights;
  for (const Vec3 p : mesh.points) heights.insert(p.z);
  return heights.size();
}

TEST(LinearExtrude, SquareIsACube) {
  const TriangleMesh mesh = linear_extrude(box(0, 0, 1, 1), of_height(1));
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.facets.size(), 6u);
  EXPECT_EQ(mesh.rise, 0);
  expect_sound(mesh, 1);
  EXPECT_DOUBLE_EQ(volume(mesh), 1);
}

TEST(LinearExtrude, StraightRunsAreOneFacet) {
  const Polygons l{{{{0, 0}, {1, 0}, {3, 0}, {3, 1}, {3, 2}, {1, 2}, {0, 2}, {0, 1}}}};
  EXPECT_EQ(linear_extrude(l, of_height(1)).facets.size(), 6u);
  // A slanted run in decimals is straight as far as rounding goes.
  const Polygons slanted{{{{0, 0}, {0.1, 0.1}, {0.3, 0.3}, {0.7, 0.7}, {0, 0.7}}}};
  const TriangleMesh mesh = linear_extrude(slanted, of_height(1));
  EXPECT_EQ(mesh.facets.size(), 5u);
  expect_sound(mesh, 1);
  // A notch divides a side: its pieces lie in one plane.
  const Polygons notched{{{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {3, 0}, {3, 2}, {0, 2}}}};
  EXPECT_EQ(linear_extrude(notched, of_height(1)).facets.size(), 9u);
}

TEST(LinearExtrude, CirclesKeepTheirSides) {
  for (const int n : {3, 100, 2048})
    EXPECT_EQ(linear_extrude({{circle(1, n)}}, of_height(1)).facets.size(), size_t(n) + 2);
}

TEST(LinearExtrude, CenterIsHalfOfTheVector) {
  LinearExtrude how = of_height(4);
  how.center = true;
  how.direction = Vec3{0.6, 0, 0.8};
  const TriangleMesh mesh = linear_extrude(box(0, 0, 1, 1), how);
  expect_sound(mesh, 4);
  EXPECT_NEAR(volume(mesh), 3.2, 1e-12);
  for (const Vec3 p : mesh.points) EXPECT_DOUBLE_EQ(std::abs(p.z), 1.6);
}

TEST(LinearExtrude, ScaledIsAFrustumOrAPyramid) {
  for (const double scale : {0.0, 0.5, 2.0}) {
    const TriangleMesh mesh = linear_extrude(frame(), twisted(0, scale, scale, 0));
    expect_sound(mesh, 20);
    EXPECT_NEAR(volume(mesh), 84 * 10 * (1 + scale + scale * scale) / 3, 1e-9);
    EXPECT_EQ(levels(mesh), 2u);
    EXPECT_EQ(mesh.facets.size(), scale == 0 ? 9u : 10u);
  }
  // Less than nothing is nothing.
  EXPECT_NEAR(volume(linear_extrude(frame(), twisted(0, -1, -1, 0))), 280, 1e-9);
}

TEST(LinearExtrude, ScaledToALineIsClosed) {
  const TriangleMesh wedge = linear_extrude(frame(), twisted(0, 1, 0, 0));
  expect_sound(wedge, 10);
  EXPECT_NEAR(volume(wedge), 420, 1e-9);
  expect_sound(linear_extrude({{circle(5, 7)}}, twisted(30, 0, 1, 4)), 10);
}

// Slices, triangles and volumes are what OpenSCAD 2021.01 writes for the same program.
TEST(LinearExtrude, SlicesAndDiagonalsAreOpenscads) {
  const Polygons triangle{{{{0, 0}, {10, 0}, {3, 7}}}};
  struct Case {
    Polygons polygons;
    LinearExtrude how;
    double fn;
    size_t triangles;
    double volume;
  };
  const Case cases[] = {
      {box(0, 0, 10, 10), twisted(90, 1, 1, 0), 0, 68, 1058.63},
      {box(0, 0, 10, 10), twisted(-90, 1, 1, 0), 20, 44, 1086.69},
      {box(0, 0, 10, 10), twisted(0, 2, 1, 0), 0, 68, 1500},
      {box(0, 0, 10, 10), twisted(0, 0.5, 2, 0), 7, 60, 1083.33},
      {box(0, 0, 10, 10), twisted(50, 2, 2, 0), 0, 44, 2388.73},
      {box(0, 0, 10, 10), twisted(180, 1, 1, 1), 0, 12, 333.333},
      {triangle, twisted(0, 2, 1, 0), 0, 50, 522.083},
      {triangle, twisted(50, 0.3, 0.3, 0), 0, 32, 170.611},
      {triangle, twisted(50, 2, 0.5, 3), 0, 20, 405.196},
      {triangle, twisted(-50, 2, 0.5, 3), 0, 20, 421.015},
      {frame(), twisted(50, 2, 0.5, 3), 0, 64, 985.522},
      {{{circle(5, 8)}}, twisted(180, 1, 1, 2), 0, 44, 569.035},
  };
  for (const Case& c : cases) {
    LinearExtrude how = c.how;
    how.fragments.fn = c.fn;
    const TriangleMesh mesh = linear_extrude(c.polygons, how);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(mesh.triangles.size(), c.triangles);
    EXPECT_NEAR(volume(mesh), c.volume, 1e-5 * c.volume);
  }
  // Where the top is a line the longer diagonals lead to it. OpenSCAD leaves that open.
  EXPECT_NEAR(volume(linear_extrude(triangle, twisted(0, 0, 1, 3))), 172.407, 1e-3);
  EXPECT_NEAR(volume(linear_extrude(triangle, twisted(0, 1, 0, 0))), 169.048, 1e-3);
}

TEST(LinearExtrude, TwistedOutlinesAreDivided) {
  LinearExtrude how = twisted(90, 1, 1, 3);
  how.segments.reset();
  how.fragments.fn = 12;  // three parts a side
  EXPECT_EQ(linear_extrude(box(-5, -5, 5, 5), how).points.size(), 12 * 4u);
  how.fragments.fn = 15;  // there is no room for four more
  EXPECT_EQ(linear_extrude(box(-5, -5, 5, 5), how).points.size(), 12 * 4u);
  how.fragments.fn = 0;  // 30 around by $fa, 20 by $fs: five a side
  EXPECT_EQ(linear_extrude(box(-5, -5, 5, 5), how).points.size(), 20 * 4u);
  how.segments = 8;
  EXPECT_EQ(linear_extrude(box(-5, -5, 5, 5), how).points.size(), 8 * 4u);
  // The longest sides come first.
  how.segments = 6;
  EXPECT_EQ(linear_extrude(box(-5, -1, 5, 1), how).points.size(), 6 * 4u);
}

TEST(LinearExtrude, NothingIsMadeOfNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double height : {0.0, -1.0, nan, infinity})
    EXPECT_TRUE(linear_extrude(box(0, 0, 1, 1), of_height(height)).triangles.empty());
  EXPECT_TRUE(linear_extrude({}, of_height(1)).triangles.empty());
  EXPECT_TRUE(linear_extrude(box(0, 0, 1, 1), twisted(nan, 1, 1, 0)).triangles.empty());
  EXPECT_TRUE(linear_extrude(box(0, 0, 1, 1), twisted(1, infinity, 1, 0)).triangles.empty());
  EXPECT_TRUE(linear_extrude(box(0, 0, 1e200, 1e200), of_height(1e200)).triangles.size() <= 12);
  LinearExtrude down = of_height(1);
  down.direction = Vec3{0, 0, -1};
  EXPECT_TRUE(linear_extrude(box(0, 0, 1, 1), down).triangles.empty());
}

TEST(LinearExtrude, BillionsOfSlicesAreNotMade) {
  const TriangleMesh mesh = linear_extrude({{circle(1, 20000)}}, twisted(360, 1, 1, 1e15));
  EXPECT_LE(mesh.triangles.size(), 2 * 5.2e5);
}

TEST(RotateExtrude, RingHasPappusVolume) {
  for (const int n : {3, 8, 100}) {
    const TriangleMesh mesh = rotate_extrude(box(2, 0, 3, 1), RotateExtrude{}, n);
    expect_sound(mesh, 3);
    EXPECT_EQ(mesh.points.size(), size_t(n) * 4);
    EXPECT_EQ(mesh.facets.size(), size_t(n) * 2 + 2);
    EXPECT_NEAR(volume(mesh), n * std::sin(2 * std::numbers::pi / n) * 2.5, 1e-9);
  }
}

TEST(RotateExtrude, AxisIsOnePoint) {
  // A cone, and a body with a side on the axis.
  const TriangleMesh cone = rotate_extrude({{{{0, 0}, {1, 0}, {0, 1}}}}, RotateExtrude{}, 5);
  expect_sound(cone, 1);
  EXPECT_EQ(cone.points.size(), 7u);
  EXPECT_EQ(cone.triangles.size(), 10u);
  EXPECT_EQ(cone.facets.size(), 6u);
  const TriangleMesh cylinder = rotate_extrude(box(0, 0, 1, 1), RotateExtrude{}, 4);
  expect_sound(cylinder, 1);
  EXPECT_EQ(cylinder.points.size(), 10u);
  EXPECT_DOUBLE_EQ(volume(cylinder), 2);
}

TEST(RotateExtrude, FullTurnStartsAtTheBack) {
  const TriangleMesh mesh = rotate_extrude(box(1, 0, 2, 1), RotateExtrude{}, 3);
  EXPECT_EQ(mesh.points[0], (Vec3{-1, 0, 0}));
}

TEST(RotateExtrude, PartsOfATurnHaveCaps) {
  for (const double angle : {90.0, -90.0, 359.0, 1e-3}) {
    for (const double x : {1.0, 0.0, -1.0, -2.0}) {
      RotateExtrude how;
      how.angle_degrees = angle;
      how.start_degrees = 10;
      const Polygons profile = box(x, 0, x + 1, 2);
      const TriangleMesh mesh = rotate_extrude(profile, how, 16);
      expect_sound(mesh, 3);
      const int steps = std::max(int(std::ceil(16 * std::abs(angle) / 360)), 1);
      const double step = std::abs(angle) / steps * std::numbers::pi / 180;
      EXPECT_NEAR(volume(mesh), steps * std::sin(step) * std::abs(x + 0.5) * 2, 1e-9);
    }
  }
}

TEST(RotateExtrude, OneStepOfMoreThanHalfATurnIsStillOutward) {
  RotateExtrude how;
  how.angle_degrees = 200;
  EXPECT_GT(volume(rotate_extrude(box(1, 0, 2, 1), how, 1)), 0);
}

TEST(RotateExtrude, SidesOfTheAxis) {
  EXPECT_FALSE(crosses_axis(box(0, 0, 1, 1)));
  EXPECT_FALSE(crosses_axis(box(-1, 0, 0, 1)));
  EXPECT_TRUE(crosses_axis(box(-1, 0, 1, 1)));
  EXPECT_FALSE(crosses_axis({}));
}

TEST(RotateExtrude, NothingIsMadeOfNothing) {
  RotateExtrude how;
  how.angle_degrees = 0;
  EXPECT_TRUE(rotate_extrude(box(1, 0, 2, 1), how, 8).triangles.empty());
  how.angle_degrees = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(rotate_extrude(box(1, 0, 2, 1), how, 8).triangles.empty());
  EXPECT_TRUE(rotate_extrude({}, RotateExtrude{}, 8).triangles.empty());
  EXPECT_LE(rotate_extrude({{circle(1, 1000)}}, RotateExtrude{}, std::numeric_limits<int>::max())
                .triangles.size(),
            size_t(1e6));
}

RC_GTEST_PROP(ExtrudeProperty, PrismsHaveAreaTimesHeight, ()) {
  const bool coarse = *rc::gen::arbitrary<bool>();
  const Polygons region = even_odd(*rc::gen::container<std::vector<Contour>>(
      size_t(*rc::gen::inRange(1, 4)),
      coarse ? random_contour(12, 4, 1) : random_contour(12, 1000000, 4e-6)));
  const TriangleMesh mesh = linear_extrude(region, of_height(3));
  RC_ASSERT(is_closed(mesh));
  RC_ASSERT(std::abs(volume(mesh) - 3 * area(region)) < 1e-9 * (1 + area(region)));
  RC_ASSERT(mesh.rise < 1e-8);
}

RC_GTEST_PROP(ExtrudeProperty, WhateverCrossesIsClosed, ()) {
  const Polygons wild{*rc::gen::container<std::vector<Contour>>(size_t(*rc::gen::inRange(1, 4)),
                                                                random_contour(12, 4, 1))};
  const double degrees = *rc::gen::element(0.0, 30.0, -500.0);
  const double x = *rc::gen::element(0.0, 1.0, 2.0), y = *rc::gen::element(0.0, 1.0, 2.0);
  LinearExtrude how = twisted(degrees, x, y, *rc::gen::inRange(0, 4));
  if (*rc::gen::arbitrary<bool>()) how.segments = *rc::gen::inRange(0, 40);
  RC_ASSERT(is_closed(linear_extrude(wild, how)));
  const RotateExtrude turn{*rc::gen::element(360.0, 77.0, -200.0), 5, {}};
  RC_ASSERT(is_closed(rotate_extrude(wild, turn, 7)));
}

RC_GTEST_PROP(ExtrudeProperty, RevolvedVolumesArePappus, ()) {
  Contour contour = *random_contour(12, 4, 1);
  for (Vec2& corner : contour) corner.x += 4;
  const Polygons region = even_odd(std::array{contour});
  RotateExtrude how;
  how.angle_degrees = *rc::gen::element(360.0, 90.0, -123.0);
  const int n = *rc::gen::inRange(3, 20);
  const int steps = int(std::ceil(n * std::abs(how.angle_degrees) / 360));
  const double step = std::abs(how.angle_degrees) / steps * std::numbers::pi / 180;
  double moment = 0;  // the integral of x
  for (const Contour& c : region.contours)
    for (size_t i = 0; i < c.size(); ++i) {
      const Vec2 a = c[i], b = c[(i + 1) % c.size()];
      moment += (a.x + b.x) * cross(a, b) / 6;
    }
  const TriangleMesh mesh = rotate_extrude(region, how, n);
  RC_ASSERT(is_closed(mesh));
  RC_ASSERT(std::abs(volume(mesh) - steps * std::sin(step) * moment) < 1e-6);
}

}  // namespace
}  // namespace whittle

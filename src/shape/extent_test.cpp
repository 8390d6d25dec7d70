#include "shape/extent.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shape/shape.h"

namespace whittle {
namespace {

TEST(Extent, OfACubeIsItsDiagonalAndItsLeastEdge) {
  const Extent e = extent(Cube{.size = {4, 2, 3}}, translation({10, 0, 0}) * scaling({1, 5, 1}));
  EXPECT_EQ(e.center, (Vec3{12, 5, 1.5}));
  EXPECT_DOUBLE_EQ(e.radius, 0.5 * std::sqrt(16.0 + 100 + 9));
  EXPECT_DOUBLE_EQ(e.width, 3);
}

TEST(Extent, WidthIsAcrossTheFacesHoweverTheyAreTurned) {
  const Affine turned = {.row = {{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}}, .translation = {}};
  EXPECT_NEAR(extent(Cube{.size = {4, 0.001, 3}}, turned).width, 0.001, 1e-15);
  // A shear lays the faces of a cube closer together: the distance of 1 becomes 1 / sqrt(2).
  const Affine sheared = {.row = {{1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, .translation = {}};
  EXPECT_NEAR(extent(Cube{}, sheared).width, std::sqrt(0.5), 1e-15);
}

TEST(Extent, OfCurves) {
  EXPECT_NEAR(extent(Sphere{.r = 3}, Affine{}).width, 6, 1e-15);
  EXPECT_NEAR(extent(Sphere{.r = 3}, Affine{}).radius, 3, 1e-15);
  const double squashed = extent(Sphere{.r = 1}, scaling({1000, 1000, 1})).width;
  EXPECT_GE(squashed, 2);
  EXPECT_LE(squashed, 2 * std::sqrt(3.0));
  EXPECT_NEAR(extent(Cylinder{.h = 0.5, .r1 = 2, .r2 = 2}, Affine{}).width, 0.5, 1e-15);
  EXPECT_NEAR(extent(Cylinder{.h = 50, .r1 = 2, .r2 = 0}, Affine{}).width, 2, 1e-15);
  const Extent tube = extent(Cylinder{.h = 8, .r1 = 3, .r2 = 3}, Affine{});
  EXPECT_NEAR(length(tube.center - Vec3{0, 0, 4}), 0, 1e-14);
  EXPECT_NEAR(tube.radius, 5, 1e-14);
}

TEST(Extent, AHalfSpaceIsAsLargeAsTheRegion) {
  const Box region = {{0, 0, 0}, {2, 2, 1}};
  const Extent e = within(extent(Halfspace{}, Affine{}), region);
  EXPECT_EQ(e.center, (Vec3{1, 1, 0.5}));
  EXPECT_EQ(e.radius, 1.5);
  EXPECT_EQ(own_tolerance(1e-6, e, 0), 1e-6);
}

TEST(Extent, AToleranceIsNoMoreThanThePrimitiveBearsAndNoLessThanRoundingCanTell) {
  const Extent thin = {.center = {}, .radius = 1, .width = 1e-4};
  EXPECT_DOUBLE_EQ(own_tolerance(1e-6, thin, 1e-9), 1e-7);
  EXPECT_EQ(own_tolerance(1e-8, thin, 1e-9), 1e-8);
  EXPECT_EQ(own_tolerance(1e-6, thin, 2e-7), 2e-7);
}

TEST(Extent, WhatMovesTogetherMovesByTheLargestToleranceThatTheThinnestBears) {
  EXPECT_EQ(joint_tolerance(1e-6, 1, 1e-9), 1e-6);
  EXPECT_DOUBLE_EQ(joint_tolerance(1e-6, 1.5e-6, 1e-9), 1e-7);
  EXPECT_EQ(joint_tolerance(1e-6, 1e-12, 1e-9), 1e-9);
}

TEST(Extent, OfSeveralIsTheSmallestBallAroundTheirsAndTheLeastWidth) {
  const Extent a = {{0, 0, 0}, 1, 0.5}, b = {{4, 0, 0}, 2, 3}, inner = {{0.5, 0, 0}, 0.25, 0.1};
  const Extent both = united(a, b);
  EXPECT_EQ(both.center, (Vec3{2.5, 0, 0}));
  EXPECT_EQ(both.radius, 3.5);
  EXPECT_EQ(both.width, 0.5);
  EXPECT_EQ(united(b, a).center, both.center);
  for (const Extent& e : {united(a, inner), united(inner, a)}) {
    EXPECT_EQ(e.center, a.center);
    EXPECT_EQ(e.radius, a.radius);
    EXPECT_EQ(e.width, inner.width);
  }
}

TEST(Extent, OutlinesLieOnTheSurface) {
  for (const Vec3 p : outline(Sphere{.r = 2})) EXPECT_NEAR(length(p), 2, 1e-15);
  const auto side = outline(Cylinder{.h = 4, .r1 = 2, .r2 = 0});
  EXPECT_EQ(side.size(), 16u);  // not the apex
  for (const Vec3 p : side) EXPECT_NEAR(std::hypot(p.x, p.y), 2 - p.z / 2, 1e-15);
}

}  // namespace
}  // namespace whittle

#include "viewer/orbit_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "trace/named_view.h"
#include "whittle/camera_text.h"

namespace whittle {
namespace {

constexpr PictureSize kViewSize{800, 600};

OrbitView some_view(bool orthographic) {
  return {{1, 2, 3}, {60, 0, 30}, 50, 30, orthographic};
}

/// Where a point is seen, in pixels.
std::pair<double, double> seen_at(const OrbitView& view, Vec3 p) {
  const Camera camera = camera_of(view, kViewSize);
  const Vec3 d = p - camera.eye;
  const double depth = view.orthographic ? 1 : dot(d, camera.forward);
  const double s = camera.units_per_pixel() * depth;
  return {kViewSize.width / 2.0 + dot(d, camera.right) / s,
          kViewSize.height / 2.0 - dot(d, camera.up) / s};
}

void expect_seen_at(const OrbitView& view, Vec3 p, double x, double y) {
  const auto [seen_x, seen_y] = seen_at(view, p);
  EXPECT_NEAR(seen_x, x, 1e-6);
  EXPECT_NEAR(seen_y, y, 1e-6);
}

TEST(OrbitViewTest, WhatIsInFrontFollowsADrag) {
  for (const bool orthographic : {false, true}) {
    const OrbitView front = rotated_to(some_view(orthographic), rotation_of(NamedView::kFront));
    const Vec3 near = front.target + Vec3{0, -1, 0};
    const auto before = seen_at(front, near), right = seen_at(orbited(front, 10, 0), near),
               down = seen_at(orbited(front, 0, 10), near);
    EXPECT_GT(right.first, before.first + 1);
    EXPECT_GT(down.second, before.second + 1);
    expect_seen_at(orbited(front, 35, -12), front.target, 400, 300);
  }
}

TEST(OrbitViewTest, ADragTurnsBySevenTenthsOfADegreeAPixel) {
  EXPECT_EQ(orbited(some_view(false), 0, 10).rotation_degrees, (Vec3{53, 0, 30}));
  EXPECT_EQ(orbited(some_view(false), 100, 0).rotation_degrees, (Vec3{60, 0, 320}));
}

TEST(OrbitViewTest, WhatIsPannedFollowsTheDrag) {
  for (const bool orthographic : {false, true}) {
    const OrbitView view = some_view(orthographic);
    const Vec3 p{4, 1, 5};
    const Camera camera = camera_of(view, kViewSize);
    const double depth = dot(p - camera.eye, camera.forward);
    const auto [x, y] = seen_at(view, p);
    expect_seen_at(panned(view, kViewSize, 37, -21, depth), p, x + 37, y - 21);
  }
}

TEST(OrbitViewTest, ZoomKeepsThePointWhereItIs) {
  for (const bool orthographic : {false, true}) {
    const OrbitView view = some_view(orthographic);
    const Vec3 p{4, 1, 5};
    const auto [x, y] = seen_at(view, p);
    for (const double notches : {3.0, -2.0}) {
      const OrbitView closer = zoomed(view, wheel_factor(notches), p);
      EXPECT_NEAR(closer.distance, 50 * std::pow(0.9, notches), 1e-9);
      expect_seen_at(closer, p, x, y);
    }
  }
}

TEST(OrbitViewTest, ZoomEndsBeforeNumbersDo) {
  OrbitView view = some_view(false);
  for (int i = 0; i < 10000; ++i) view = zoomed(view, wheel_factor(1), {4, 1, 5});
  EXPECT_GT(view.distance, 0);
  for (int i = 0; i < 10000; ++i) view = zoomed(view, wheel_factor(-1), {4, 1, 5});
  EXPECT_LT(view.distance, 1e13);
  EXPECT_TRUE(std::isfinite(view.target.x));
}

TEST(OrbitViewTest, ThePivotIsInTheMiddle) {
  const OrbitView view = pivoted(some_view(false), {7, 8, 9});
  expect_seen_at(view, {7, 8, 9}, 400, 300);
  expect_seen_at(orbited(view, 100, 50), {7, 8, 9}, 400, 300);
}

TEST(OrbitViewTest, NamedViewsLookAlongTheAxes) {
  const auto forward = [](NamedView view) {
    return camera_of(rotated_to(some_view(false), rotation_of(view)), kViewSize).forward;
  };
  EXPECT_EQ(forward(NamedView::kFront), (Vec3{0, 1, 0}));
  EXPECT_EQ(forward(NamedView::kBack), (Vec3{0, -1, 0}));
  EXPECT_EQ(forward(NamedView::kRight), (Vec3{-1, 0, 0}));
  EXPECT_EQ(forward(NamedView::kLeft), (Vec3{1, 0, 0}));
  EXPECT_EQ(forward(NamedView::kTop), (Vec3{0, 0, -1}));
  EXPECT_EQ(forward(NamedView::kBottom), (Vec3{0, 0, 1}));
  const Vec3 isometric = forward(NamedView::kIso);
  EXPECT_NEAR(isometric.x, -std::sqrt(1.0 / 3), 1e-9);
  EXPECT_NEAR(isometric.y, std::sqrt(1.0 / 3), 1e-9);
}

TEST(OrbitViewTest, PointsOnTheTargetsPlaneAreSeenWhereTheyWereAskedFor) {
  for (const bool orthographic : {false, true}) {
    const OrbitView view = some_view(orthographic);
    expect_seen_at(view, point_on_target_plane(view, kViewSize, 123, 456), 123, 456);
  }
}

TEST(OrbitViewTest, RoundedViewsAreShortToWrite) {
  OrbitView view = some_view(false);
  view.target = {0.1 + 0.2, -1.0 / 3, 1e-9};
  view.rotation_degrees = {54.999999, 0, 359.9999};
  view.distance = 47.123456789;
  const OrbitView written = rounded(view);
  EXPECT_EQ(camera_text(view_options(written, kViewSize)), "0.3,-0.3333,0,55,0,0,47.1235");
  EXPECT_EQ(rounded(written), written);
  view.distance = 2e8;
  view.target = {123456789, 0, 0};
  EXPECT_EQ(camera_text(view_options(rounded(view), kViewSize)), "123457000,0,0,55,0,0,200000000");
}

TEST(OrbitViewTest, RoundingMovesNothingByAPixel) {
  OrbitView view = some_view(false);
  view.target = {1.23456789, 2.3456789, 3.456789};
  view.rotation_degrees = {61.234567, 0, 12.345678};
  for (const Vec3 p : {Vec3{1, 2, 3}, Vec3{5, 5, 5}, Vec3{-3, 2, 9}}) {
    const auto [x, y] = seen_at(view, p);
    const auto [near_x, near_y] = seen_at(rounded(view), p);
    EXPECT_NEAR(near_x, x, 0.05);
    EXPECT_NEAR(near_y, y, 0.05);
  }
}

TEST(OrbitViewTest, ACameraTextGivesTheViewBack) {
  const OrbitView view = rounded(some_view(false));
  const Result<ViewOptions> parsed = parse_camera(camera_text(view_options(view, kViewSize)));
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->target, view.target);
  EXPECT_EQ(parsed->rotation_degrees, view.rotation_degrees);
  EXPECT_EQ(parsed->distance, view.distance);
}

}  // namespace
}  // namespace whittle

#include "trace/pixel_threshold.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// Looks along +y from (0, -100, 0); a unit at the origin's distance is 5.12 pixels high.
Camera camera_at_100() {
  Camera camera;
  camera.eye = {0, -100, 0};
  camera.half_height = 0.5;
  return camera;
}

Camera orthographic_camera() {
  Camera camera = camera_at_100();
  camera.orthographic = true;
  camera.half_height = 50;
  camera.ortho_reach = 1000;
  return camera;
}

bool is_below_pixels(const Camera& camera, const Box& box, double pixels) {
  return PixelThreshold(camera, pixels)(box);
}

Box cube_at(Vec3 center, double edge) {
  const Vec3 half = Vec3{1, 1, 1} * (edge / 2);
  return {center - half, center + half};
}

TEST(PixelThreshold, TurnsAtTheProjectedLengthOfTheLongestEdge) {
  // The nearest edges, at distance 100, are 2 / 100 high, of a picture that is 1 high: 10.24 px.
  const Box box = cube_at({0, 1, 0}, 2);
  EXPECT_TRUE(is_below_pixels(camera_at_100(), box, 10.3));
  EXPECT_FALSE(is_below_pixels(camera_at_100(), box, 10.2));
}

TEST(PixelThreshold, TurnsAtTheEdgeItselfIfOrthographic) {
  // 2 of 100 units, whatever the distance.
  for (const double y : {-90.0, 0.0, 5000.0}) {
    const Box box = cube_at({3, y, 3}, 2);
    EXPECT_TRUE(is_below_pixels(orthographic_camera(), box, 10.3)) << y;
    EXPECT_FALSE(is_below_pixels(orthographic_camera(), box, 10.2)) << y;
  }
}

TEST(PixelThreshold, WhatIsOutOfSightIsSmall) {
  EXPECT_TRUE(is_below_pixels(camera_at_100(), cube_at({0, -200, 0}, 50), 1)) << "behind the eye";
  EXPECT_TRUE(is_below_pixels(camera_at_100(), cube_at({500, 0, 0}, 50), 1)) << "beside";
}

TEST(PixelThreshold, CountsOnlyTheVisiblePartOfAnEdge) {
  // Ends 0.1 below the upper border of the picture (z = 50 at this distance) and goes on far above.
  const Box box{{-0.01, 0, 49.9}, {0.01, 0.02, 500}};
  EXPECT_TRUE(is_below_pixels(camera_at_100(), box, 1));
  const Box lower{{-0.01, 0, 49}, {0.01, 0.02, 500}};
  EXPECT_FALSE(is_below_pixels(camera_at_100(), lower, 1));
}

TEST(PixelThreshold, WhatCoversTheScreenIsNotSmall) {
  const Box around_the_eye = cube_at({0, -100, 0}, 1000);
  EXPECT_FALSE(is_below_pixels(camera_at_100(), around_the_eye, 1));
  const Box wall{{-1000, 0, -1000}, {1000, 1, 1000}};
  EXPECT_FALSE(is_below_pixels(camera_at_100(), wall, 1));
  EXPECT_FALSE(is_below_pixels(orthographic_camera(), wall, 1));
}

TEST(PixelThreshold, WhatCoversAllButACornerIsNotSmall) {
  // Leaves out a triangle of less than a pixel in the upper right corner (50, 50).
  Camera camera = camera_at_100();
  camera.right = normalize(Vec3{1, 0, 1});
  camera.up = normalize(Vec3{-1, 0, 1});
  const double corner = 50 * std::sqrt(2.0);  // of the turned picture, straight above
  const Box box{{-1000, 0, -1000}, {1000, 0.001, corner - 0.05}};
  EXPECT_FALSE(is_below_pixels(camera, box, 1));
  const Box only_the_corner{{-1000, 0, corner - 0.05}, {1000, 0.001, 1000}};
  EXPECT_TRUE(is_below_pixels(camera, only_the_corner, 1));
}

TEST(PixelThreshold, WithoutClippingTheProjectedCornersDecide) {
  EXPECT_TRUE(rc::check("for boxes that are visible as a whole", [](bool orthographic) {
    const Camera camera = orthographic ? orthographic_camera() : camera_at_100();
    const auto between = [](double lo, double hi) {
      return lo + (hi - lo) * *rc::gen::inRange(0, 1001) / 1000;
    };
    const Vec3 lo{between(-20, 10), between(-20, 10), between(-20, 10)};
    const Box box{lo, lo + Vec3{between(0.01, 9), between(0.01, 9), between(0.01, 9)}};
    double longest = 0;
    for (int i = 0; i < 8; ++i) {
      for (const int bit : {1, 2, 4}) {
        const Vec3 a = box.corner(i) - camera.eye, b = box.corner(i ^ bit) - camera.eye;
        const double wa = orthographic ? 50 : a.y / 2, wb = orthographic ? 50 : b.y / 2;
        longest = std::max(longest, 256 * std::hypot(a.x / wa - b.x / wb, a.z / wa - b.z / wb));
      }
    }
    RC_ASSERT(is_below_pixels(camera, box, longest * 1.001));
    RC_ASSERT(!is_below_pixels(camera, box, longest * 0.999));
  }));
}

}  // namespace
}  // namespace whittle

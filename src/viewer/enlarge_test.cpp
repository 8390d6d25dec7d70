#include "viewer/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace whittle {
namespace {

TEST(EnlargeTest, CoarsePixelsLieInTheMiddleOfTheFineOnesThatTheyStandFor) {
  Camera camera;
  camera.half_height = 0.3;
  for (const auto& [width, height] : {std::pair{96, 60}, std::pair{97, 61}, std::pair{5, 3}}) {
    camera.width = width, camera.height = height;
    for (const int scale : {1, 2, 3, 4}) {
      const Camera coarse = coarse_camera(camera, scale);
      const double over_x = (coarse.width * scale - width) / 2.0,
                   over_y = (coarse.height * scale - height) / 2.0;
      const Ray expected = camera.ray(1.5 * scale - over_x, 0.5 * scale - over_y),
                ray = coarse.ray(1.5, 0.5);
      EXPECT_NEAR(length(ray.direction - expected.direction), 0, 1e-12);
    }
  }
}

TEST(EnlargeTest, ARampStaysARamp) {
  const int scale = 4;
  Picture coarse(10, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 4; ++c) coarse.at(x, y)[c] = uint8_t(10 * x + 5 * y + c);
  const Picture fine = enlarged(coarse, scale, 38, 30, Workers(2));
  for (int y = 4; y < 26; ++y)
    for (int x = 4; x < 34; ++x)
      for (int c = 0; c < 4; ++c) {
        const double at_x = (x + 0.5 - 19) / scale + 5 - 0.5,
                     at_y = (y + 0.5 - 15) / scale + 4 - 0.5;
        EXPECT_NEAR(fine.at(x, y)[c], 10 * at_x + 5 * at_y + c, 1.01) << x << ' ' << y;
      }
}

TEST(EnlargeTest, OfOneScaleItIsThePicture) {
  Picture picture(7, 5);
  for (size_t i = 0; i < picture.rgba.size(); ++i) picture.rgba[i] = uint8_t(i * 37);
  const Picture same = enlarged(picture, 1, 7, 5, Workers(1));
  EXPECT_TRUE(std::ranges::equal(same.rgba, picture.rgba));
}

TEST(EnlargeTest, EvenOnePixelFillsAPicture) {
  Picture one(1, 1);
  std::ranges::fill(one.rgba, uint8_t(77));
  const Picture fine = enlarged(one, 12, 9, 2, Workers(1));
  for (const uint8_t value : fine.rgba) EXPECT_EQ(value, 77);
}

}  // namespace
}  // namespace whittle

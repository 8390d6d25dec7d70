#include "image/line_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/box.h"

namespace whittle {
namespace {

const Ink kBlackInk{{0, 0, 0}, 1};

/// Looks along y from the origin; a pixel is 1/8 at distance 1, or everywhere.
Camera line_camera(bool orthographic) {
  Camera camera;
  camera.orthographic = orthographic;
  camera.ortho_reach = orthographic ? 100 : 0;
  camera.width = camera.height = 16;
  return camera;
}

/// The strength of every pixel's ink, rows from the top.
std::vector<float> line_strengths(const Camera& camera, Vec3 from, Vec3 to,
                                  double occluder = kInfinity) {
  const std::vector<double> occluders(256, occluder);
  LineLayer lines(camera, occluders);
  lines.draw(from, to, kBlackInk);
  std::vector<float> strengths;
  for (const Ink& ink : lines.inks()) strengths.push_back(ink.strength);
  return strengths;
}

float line_sum(const std::vector<float>& strengths) {
  float total = 0;
  for (const float s : strengths) total += s;
  return total;
}

TEST(LineLayer, APixelIsCoveredByItsDistanceFromTheLine) {
  // Through the middles of row 5, from x = 3 to x = 12.
  const double y = (8 - 5.5) / 8;
  for (const bool orthographic : {false, true}) {
    const double depth = orthographic ? 1 : 4, scale = orthographic ? 1 : depth;
    const std::vector<float> strengths =
        line_strengths(line_camera(orthographic), {-5.0 / 8 * scale, depth, y * scale},
                       {4.0 / 8 * scale, depth, y * scale});
    for (int row = 0; row < 16; ++row) {
      EXPECT_FLOAT_EQ(strengths[size_t(16 * row + 8)], row == 5                 ? 1
                                                       : std::abs(row - 5) == 1 ? 0.05f
                                                                                : 0.f)
          << row;
    }
    EXPECT_FLOAT_EQ(strengths[16 * 5 + 3], 1);
    EXPECT_FLOAT_EQ(strengths[16 * 5 + 2], 0.55f) << "the round end is half a pixel away";
    EXPECT_FLOAT_EQ(strengths[16 * 5 + 1], 0);
  }
}

TEST(LineLayer, ALineIsAsWideWhateverItsDirection) {
  const Camera camera = line_camera(true);
  // 10 pixels long, and ends of which two make a disc.
  const float expected = line_sum(line_strengths(camera, {-5.0 / 8, 1, 0.1}, {5.0 / 8, 1, 0.1}));
  EXPECT_NEAR(expected, 11 * 1.1, 0.5);
  for (double angle = 0; angle < 3.2; angle += 0.1) {
    const Vec3 half{std::cos(angle) * 5 / 8, 0, std::sin(angle) * 5 / 8}, middle{0, 1, 0.01};
    EXPECT_NEAR(line_sum(line_strengths(camera, middle - half, middle + half)), expected,
                0.08 * expected)
        << angle << ": more than coverage by distance from the middle of a pixel is off";
  }
}

TEST(LineLayer, WhatStandsInFrontHidesALineAndOnlyThat) {
  for (const bool orthographic : {false, true}) {
    const Camera camera = line_camera(orthographic);
    // Row 8 runs from distance 10 on the left to 20 on the right.
    const double left = orthographic ? 1 : 10, right = orthographic ? 1 : 20;
    const Vec3 from{-7.0 / 8 * left, 10, 0}, to{7.0 / 8 * right, 20, 0};
    const auto seen = [&](double occluder) {
      return line_sum(line_strengths(camera, from, to, occluder));
    };
    EXPECT_EQ(seen(1), 0);
    EXPECT_EQ(seen(40), seen(kInfinity));
    EXPECT_GT(seen(15), 0.2 * seen(kInfinity));
    EXPECT_LT(seen(15), 0.9 * seen(kInfinity));
    const std::vector<float> half = line_strengths(camera, from, to, 14);
    EXPECT_GT(half[16 * 8 + 2], 0.4f) << "near";
    EXPECT_EQ(half[16 * 8 + 14], 0) << "far";
  }
}

TEST(LineLayer, ALineInASurfaceIsSeen) {
  const Camera camera = line_camera(true);
  EXPECT_GT(line_sum(line_strengths(camera, {-0.5, 7, 0}, {0.5, 7, 0}, 7)), 8);
}

TEST(LineLayer, OnlyWhatIsInFrontOfTheEyeIsDrawn) {
  const Camera camera = line_camera(false);
  EXPECT_EQ(line_sum(line_strengths(camera, {-1, -4, 0}, {1, -4, 0})), 0);
  EXPECT_EQ(line_sum(line_strengths(camera, {-1, 0, 0}, {1, 0, 0})), 0) << "through the eye";
  EXPECT_EQ(line_sum(line_strengths(camera, {0, 0, 0}, {0, 0, 0})), 0) << "a dot at the eye";
  // From behind the eye to the right, past the picture's right side, to a point in its middle.
  const std::vector<float> strengths = line_strengths(camera, {4, -4, 0}, {0, 8, 0});
  EXPECT_GT(strengths[16 * 8 + 12], 0.4f);
  EXPECT_EQ(strengths[16 * 8 + 4], 0);
}

TEST(LineLayer, EndsFarOutsideAreNoMatter) {
  const Camera camera = line_camera(false);
  EXPECT_EQ(line_strengths(camera, {-1e9, 4, 0.25}, {1e9, 4, 0.25}),
            line_strengths(camera, {-1e3, 4, 0.25}, {1e3, 4, 0.25}));
}

TEST(LineLayer, TheStrongestLineCountsAndOfEqualOnesTheFirst) {
  const std::vector<double> occluders(256, kInfinity);
  const Camera camera = line_camera(true);
  LineLayer lines(camera, occluders);
  const Vec3 from{-0.5, 1, -0.5 / 8}, to{0.5, 1, -0.5 / 8};
  lines.draw(from, to, {{1, 0, 0}, 0.5f});
  lines.draw(from, to, {{0, 1, 0}, 0.5f});
  EXPECT_EQ(lines.inks()[16 * 8 + 8].color, (Vec3f{1, 0, 0}));
  lines.draw(from, to, {{0, 0, 1}, 0.75f});
  EXPECT_EQ(lines.inks()[16 * 8 + 8].color, (Vec3f{0, 0, 1}));
  EXPECT_EQ(lines.inks()[16 * 8 + 8].strength, 0.75f);
}

TEST(Ink, LiesOverOpaqueAndTransparentPixels) {
  Picture picture(3, 1);
  for (int c = 0; c < 4; ++c) picture.at(0, 0)[c] = picture.at(2, 0)[c] = 255;
  const Ink red{{1, 0, 0}, 0.5f};
  lay_over(std::vector<Ink>{red, red, {}}, picture);
  const auto is = [&](int x, std::vector<int> rgba) {
    EXPECT_EQ(std::vector<int>(picture.at(x, 0), picture.at(x, 0) + 4), rgba) << x;
  };
  is(0, {255, 128, 128, 255});
  is(1, {255, 0, 0, 128});
  is(2, {255, 255, 255, 255});
}

}  // namespace
}  // namespace whittle

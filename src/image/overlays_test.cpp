#include "image/overlays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr int kSize = 200;

/// From the front, a pixel is a tenth.
Camera front_camera() {
  Camera camera;
  camera.eye = {0, -50, 0};
  camera.orthographic = true;
  camera.half_height = kSize / 20.0;
  camera.ortho_reach = 100;
  camera.width = camera.height = kSize;
  return camera;
}

Frame empty_frame() {
  return Frame(kSize, kSize);
}

Picture white_picture() {
  Picture picture(kSize, kSize);
  std::ranges::fill(picture.rgba, uint8_t(255));
  return picture;
}

bool is_white(const uint8_t* rgba) {
  return rgba[0] == 255 && rgba[1] == 255 && rgba[2] == 255;
}

const Box kBox{{-4, -4, -4}, {4, 4, 4}};

TEST(Overlays, AxesAreSeenWhereNothingIsBeforeThem) {
  const Camera camera = front_camera();
  Frame frame = empty_frame();
  // On the right half there is something right before the axis.
  for (int y = 0; y < kSize; ++y)
    for (int x = kSize / 2 + 5; x < kSize; ++x)
      frame.hits[size_t(y * kSize + x)] = {.distance = 45, .id = 1, .normal = {0, -1, 0}};
  Picture picture = white_picture();
  draw_overlays({.axes = true}, camera, frame, kBox, picture);
  const int row = kSize / 2;  // z = 0, or half a pixel below
  EXPECT_FALSE(is_white(picture.at(80, row)));
  EXPECT_GT(picture.at(80, row)[0], picture.at(80, row)[1]) << "x is red";
  EXPECT_TRUE(is_white(picture.at(120, row))) << "hidden";
  // z is on the left of what hides, and blue; it ends 0.15 of the longest edge beyond the box.
  EXPECT_FALSE(is_white(picture.at(kSize / 2, 52)));
  EXPECT_GT(picture.at(kSize / 2, 60)[2], picture.at(kSize / 2, 60)[0]);
  EXPECT_TRUE(is_white(picture.at(kSize / 2, 30)));
}

TEST(Overlays, WhatIsBehindAnAxisDoesNotHideIt) {
  const Camera camera = front_camera();
  Frame frame = empty_frame();
  std::ranges::fill(frame.hits, Hit{.distance = 55, .id = 1, .normal = {0, -1, 0}});
  Picture picture = white_picture();
  draw_overlays({.axes = true}, camera, frame, kBox, picture);
  EXPECT_FALSE(is_white(picture.at(120, kSize / 2)));
}

TEST(Overlays, AGridLiesAtRoundLengths) {
  Camera camera = front_camera();
  camera.eye = {0, 0, 50};
  camera.up = {0, 1, 0};
  camera.forward = {0, 0, -1};
  Picture picture = white_picture();
  draw_overlays({.grid = true}, camera, empty_frame(), kBox, picture);
  // Twelve long with what is beyond: 1 apart, which is ten pixels, from -6 to 6.
  for (int x = 40; x <= 160; x += 10) EXPECT_FALSE(is_white(picture.at(x, 74))) << x;
  for (int x = 45; x < 160; x += 10) EXPECT_TRUE(is_white(picture.at(x, 74))) << x;
  EXPECT_TRUE(is_white(picture.at(30, 74)));
}

TEST(Overlays, AScaleBarIsAsLongAsItSays) {
  Picture picture = white_picture();
  draw_overlays({.scale_bar = true}, front_camera(), empty_frame(), kBox, picture);
  // A quarter of 20 is 5, which is 50 pixels.
  const int y = kSize - 6;
  int first = kSize, last = 0;
  for (int x = 0; x < kSize; ++x)
    if (picture.at(x, y)[0] < 200) first = std::min(first, x), last = std::max(last, x);
  EXPECT_NEAR(last - first, 50, 1.5);
}

TEST(Overlays, ATitleIsReadableOnAnyBackground) {
  for (const uint8_t level : {uint8_t(255), uint8_t(10)}) {
    Picture picture(kSize, kSize);
    for (size_t i = 0; i < picture.rgba.size(); ++i)
      picture.rgba[i] = i % 4 == 3 ? uint8_t(255) : level;
    draw_overlays({.title = "Bracket 7"}, front_camera(), empty_frame(), kBox, picture);
    int strongest = 0;
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < kSize; ++x)
        strongest = std::max(strongest, std::abs(picture.at(x, y)[0] - level));
    EXPECT_GT(strongest, 120);
    for (int x = 0; x < kSize; ++x) EXPECT_EQ(picture.at(x, 40)[0], level);
  }
}

TEST(Overlays, BoxesWithoutEndDoNoHarm) {
  for (const Box& box : {Box{}, Box::everything()}) {
    Picture picture = white_picture();
    draw_overlays({.axes = true, .grid = true, .scale_bar = true}, front_camera(), empty_frame(),
                  box, picture);
    EXPECT_FALSE(is_white(picture.at(105, kSize / 2)));
  }
}

TEST(Overlays, RoundLengths) {
  EXPECT_DOUBLE_EQ(round_length(1), 1);
  EXPECT_DOUBLE_EQ(round_length(1.99), 1);
  EXPECT_DOUBLE_EQ(round_length(4.99), 2);
  EXPECT_DOUBLE_EQ(round_length(70), 50);
  EXPECT_DOUBLE_EQ(round_length(0.034), 0.02);
  for (double longest = 1e-6; longest < 1e6; longest *= 1.7) {
    const GridLines lines = grid_lines(-longest / 3, longest * 2 / 3, longest);
    EXPECT_GE(lines.count, 10) << longest;
    EXPECT_LE(lines.count, 30) << longest;
    EXPECT_LE(lines.first, -longest / 3);
    EXPECT_GE(lines.first + (lines.count - 1) * lines.step, longest * 2 / 3 - 1e-9 * longest);
  }
}

}  // namespace
}  // namespace whittle

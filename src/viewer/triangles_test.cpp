#include "viewer/triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace whittle {
namespace {

constexpr uint8_t kFull = 255;
constexpr Texture kWhite{&kFull, 1, 1};
constexpr uint32_t kRed = 0xff0000ff, kHalfBlue = 0x80ff0000;

struct Canvas {
  int width, height;
  std::vector<uint32_t> at = std::vector<uint32_t>(size_t(width) * size_t(height), 0);

  Pixels pixels() { return {at.data(), width, height, width}; }
  ClipRect all() const { return {0, 0, width, height}; }
  uint32_t operator()(int x, int y) const { return at[size_t(y) * size_t(width) + size_t(x)]; }
};

void draw(Canvas& canvas, const std::vector<Vertex>& v, const Texture& texture = kWhite) {
  std::vector<uint16_t> indices;
  for (size_t i = 0; i < v.size(); ++i) indices.push_back(uint16_t(i));
  draw_triangles(canvas.pixels(), canvas.all(), v, indices, texture);
}

/// Two triangles.
std::vector<Vertex> rectangle(float x0, float y0, float x1, float y1, uint32_t color) {
  const Vertex a{x0, y0, 0, 0, color}, b{x1, y0, 1, 0, color}, c{x1, y1, 1, 1, color},
      d{x0, y1, 0, 1, color};
  return {a, b, c, a, c, d};
}

TEST(TrianglesTest, ARectangleHasThePixelsWhoseCentresItHolds) {
  Canvas canvas{10, 8};
  draw(canvas, rectangle(2.5f, 1, 7, 5.4f, kRed));
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 10; ++x)
      EXPECT_EQ(canvas(x, y), x >= 2 && x < 7 && y >= 1 && y < 5 ? 0xff0000u : 0u) << x << ' ' << y;
}

TEST(TrianglesTest, TrianglesThatShareEdgesLeaveNoGapAndNoOverlap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-8, 40);
  for (int run = 0; run < 300; ++run) {
    // A fan around a point, with a translucent colour: what is drawn twice is brighter.
    Canvas canvas{32, 32};
    const float x = anywhere(random), y = anywhere(random);
    std::vector<Vertex> fan;
    constexpr int kParts = 7;
    const auto corner = [&](int i) {
      const float angle = 2 * std::acos(-1.0f) * float(i % kParts) / kParts + 0.1f;
      return Vertex{x + 90 * std::cos(angle), y + 90 * std::sin(angle), 0, 0, kHalfBlue};
    };
    for (int i = 0; i < kParts; ++i) {
      fan.push_back({x, y, 0, 0, kHalfBlue});
      // Either way around.
      fan.push_back(corner(i + run % 2));
      fan.push_back(corner(i + 1 - run % 2));
    }
    draw(canvas, fan);
    for (const uint32_t pixel : canvas.at) ASSERT_EQ(pixel, 0x80u);
  }
}

TEST(TrianglesTest, ColoursAreMixedByAlpha) {
  Canvas canvas{1, 1};
  canvas.at[0] = 0x204060;
  draw(canvas, rectangle(0, 0, 1, 1, 0x80c0a080));  // r 0x80, g 0xa0, b 0xc0
  EXPECT_EQ(canvas(0, 0), 0x507090u);
}

TEST(TrianglesTest, ColoursAreInterpolated) {
  Canvas canvas{256, 2};
  const uint32_t black = 0xff000000, white = 0xffffffff;
  draw(canvas, {{0, 0, 0, 0, black},
                {256, 0, 0, 0, white},
                {256, 2, 0, 0, white},
                {0, 0, 0, 0, black},
                {256, 2, 0, 0, white},
                {0, 2, 0, 0, black}});
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(double(canvas(x, 1) & 0xff), x, 1.01);
}

TEST(TrianglesTest, TheTextureSaysHowMuchIsThere) {
  const std::vector<uint8_t> texels{0, 255, 128, 0};
  Canvas canvas{4, 4};
  draw(canvas, rectangle(0, 0, 4, 4, 0xffffffff), {texels.data(), 2, 2});
  EXPECT_EQ(canvas(0, 0), 0u);
  EXPECT_EQ(canvas(3, 1), 0xffffffu);
  EXPECT_EQ(canvas(1, 2), 0x808080u);
  EXPECT_EQ(canvas(2, 3), 0u);
}

TEST(TrianglesTest, NothingIsDrawnOutsideOfTheClip) {
  Canvas canvas{6, 6};
  const std::vector<Vertex> vertices = rectangle(-100, -100, 100, 100, kRed);
  const std::vector<uint16_t> indices{0, 1, 2, 3, 4, 5};
  draw_triangles(canvas.pixels(), {2, 3, 50, 4}, vertices, indices, kWhite);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) EXPECT_EQ(canvas(x, y), y == 3 && x >= 2 ? 0xff0000u : 0u);
  draw_triangles(canvas.pixels(), {5, 5, 1, 1}, vertices, indices, kWhite);
  EXPECT_EQ(canvas(3, 2), 0u);
}

TEST(TrianglesTest, WhatIsNoNumberOrFarAwayDrawsNothing) {
  Canvas canvas{6, 6};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {nan, -nan, std::numeric_limits<float>::infinity(), 1e30f, -1e30f})
    draw(canvas, {{0, 0, 0, 0, kRed}, {odd, 0, 0, 0, kRed}, {0, 6, 0, 0, kRed}});
  draw(canvas, {{0, 0, nan, 0, kRed}, {6, 0, 0, 0, kRed}, {0, 6, 0, 0, kRed}});
  for (const uint32_t pixel : canvas.at) EXPECT_EQ(pixel, 0u);
}

}  // namespace
}  // namespace whittle

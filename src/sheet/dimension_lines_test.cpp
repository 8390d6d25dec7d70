#include "sheet/dimension_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

bool has_line(const std::vector<Stroke>& strokes, Vec2 a, Vec2 b) {
  const auto is_near = [](Vec2 p, Vec2 q) { return length(p - q) < 1e-9; };
  return std::ranges::any_of(strokes, [&](const Stroke& s) {
    return s.size() == 2 &&
           ((is_near(s[0], a) && is_near(s[1], b)) || (is_near(s[0], b) && is_near(s[1], a)));
  });
}

TEST(DimensionLines, BelowFromEndToEnd) {
  const std::vector<Stroke> lines = dimension_lines({10, 50}, {110, 50}, false, "100", 2);
  EXPECT_TRUE(has_line(lines, {10, 50.8}, {10, 55.2}));
  EXPECT_TRUE(has_line(lines, {110, 50.8}, {110, 55.2}));
  EXPECT_TRUE(has_line(lines, {10, 54.2}, {110, 54.2}));
  EXPECT_TRUE(has_line(lines, {10, 54.2}, {11.8, 54.64})) << "an arrow points outwards";
  for (const Stroke& stroke : lines) {
    for (const Vec2 p : stroke) {
      EXPECT_GE(p.x, 10 - 1e-9);
      EXPECT_LE(p.x, 110 + 1e-9);
      EXPECT_GT(p.y, 50);
      EXPECT_LE(p.y, 50 + 3.6 * 2);
    }
  }
}

TEST(DimensionLines, OnTheLeftFromTopToBottom) {
  const std::vector<Stroke> lines = dimension_lines({50, 10}, {50, 90}, true, "80", 2);
  EXPECT_TRUE(has_line(lines, {49.2, 10}, {45.4, 10}));
  EXPECT_TRUE(has_line(lines, {49.2, 90}, {45.4, 90}));
  EXPECT_TRUE(has_line(lines, {46.4, 10}, {46.4, 90}));
  for (const Stroke& stroke : lines) {
    for (const Vec2 p : stroke) {
      EXPECT_LT(p.x, 50);
      EXPECT_GE(p.x, 50 - 3.6 * 2);
      EXPECT_GE(p.y, 10 - 1e-9);
      EXPECT_LE(p.y, 90 + 1e-9);
    }
  }
}

TEST(DimensionLines, WithoutRoomArrowsPointInwards) {
  const std::vector<Stroke> lines = dimension_lines({10, 50}, {11, 50}, false, "1", 2);
  EXPECT_TRUE(has_line(lines, {10, 54.2}, {10 - 1.8, 54.64}));
  EXPECT_TRUE(has_line(lines, {11, 54.2}, {11 + 1.8, 54.64}));
}

}  // namespace
}  // namespace whittle

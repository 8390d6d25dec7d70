#include "sheet/stroke_font.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>

namespace whittle {
namespace {

struct Extent {
  Vec2 lo{1e9, 1e9}, hi{-1e9, -1e9};
};

Extent extent(const std::vector<Stroke>& strokes) {
  Extent e;
  for (const Stroke& stroke : strokes) {
    for (const Vec2 p : stroke) {
      e.lo = {std::min(e.lo.x, p.x), std::min(e.lo.y, p.y)};
      e.hi = {std::max(e.hi.x, p.x), std::max(e.hi.y, p.y)};
    }
  }
  return e;
}

TEST(StrokeFont, EverySignHasStrokesWithinItsPlace) {
  for (char c = '!'; c <= '~'; ++c) {
    const std::vector<Stroke> strokes = text_strokes(std::string(1, c), {10, 100}, 6);
    ASSERT_FALSE(strokes.empty()) << c;
    for (const Stroke& stroke : strokes) EXPECT_GE(stroke.size(), 2u) << c;
    const Extent e = extent(strokes);
    EXPECT_GE(e.lo.x, 10) << c;
    EXPECT_LE(e.hi.x, 10 + text_width(std::string(1, c), 6) + 1e-9) << c;
    EXPECT_GE(e.lo.y, 100 - 7) << c;
    EXPECT_LE(e.hi.y, 100 + 2) << c;
  }
  for (const char c : std::string("ABCXYZ0123456789")) {
    const Extent e = extent(text_strokes(std::string(1, c), {0, 0}, 3));
    EXPECT_DOUBLE_EQ(e.lo.y, -3) << c;
    EXPECT_DOUBLE_EQ(e.hi.y, 0) << c;
  }
}

TEST(StrokeFont, NoTwoSignsLookAlike) {
  std::vector<std::vector<Stroke>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    const std::vector<Stroke> strokes = text_strokes(std::string(1, c), {}, 1);
    // Nothing tells these apart where letters are straight strokes.
    if (c == 'O') continue;
    EXPECT_EQ(std::ranges::count(seen, strokes), 0) << c;
    seen.push_back(strokes);
  }
}

TEST(StrokeFont, DigitsStandBelowOneAnother) {
  EXPECT_DOUBLE_EQ(text_width("111", 7), text_width("888", 7));
  EXPECT_DOUBLE_EQ(text_width("", 7), 0);
  EXPECT_GT(text_width("a b", 7), text_width("ab", 7));
}

TEST(StrokeFont, WhatIsNoSignIsABox) {
  const std::vector<Stroke> box = text_strokes("\t", {}, 1);
  EXPECT_EQ(text_strokes("\xe2\x82\xac", {}, 1), box);
  EXPECT_EQ(text_strokes("\xff", {}, 1), box);
  EXPECT_EQ(text_strokes("\xe2\x82", {}, 1), box);
  EXPECT_NE(text_strokes("\xc2\xb0", {}, 1), box);
}

RC_GTEST_PROP(StrokeFont, AnyBytesAreDrawn, ()) {
  const std::string text = *rc::gen::arbitrary<std::string>();
  const double width = text_width(text, 2);
  for (const Stroke& stroke : text_strokes(text, {}, 2))
    for (const Vec2 p : stroke) RC_ASSERT(p.x >= 0 && p.x <= width + 1e-9);
}

}  // namespace
}  // namespace whittle

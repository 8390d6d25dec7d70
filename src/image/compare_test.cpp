#include "image/compare.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace whittle {
namespace {

Frame frame_of(int width, int height) {
  Frame frame(width, height);
  for (Hit& h : frame.hits) h = {100, 3, {0, 0, 1}};
  return frame;
}

TEST(Compare, AFrameEqualsItself) {
  Frame f = frame_of(5, 4);
  f.at(1, 1) = Hit{};
  const Comparison c = compare(f, f);
  EXPECT_TRUE(c.equal());
  EXPECT_EQ(c.pixels, 20u);
  EXPECT_EQ(c.max_distance_error, 0);
  EXPECT_EQ(describe(c).find("equal: 20 pixels"), 0u) << describe(c);
}

TEST(Compare, EachKindOfDifferenceIsCountedByItself) {
  const Frame a = frame_of(4, 2);
  Frame b = a;
  b.at(1, 0) = Hit{};
  b.at(2, 0).id = 4;
  b.at(0, 1).distance = 100.01f;
  b.at(3, 1).normal = {0.1f, 0, 0.994987f};
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.hit_differs, 1u);
  EXPECT_EQ(c.id_differs, 1u);
  EXPECT_EQ(c.distance_differs, 1u);
  EXPECT_EQ(c.normal_differs, 1u);
  EXPECT_EQ(c.differing, 4u);
  EXPECT_FALSE(c.equal());
  EXPECT_NEAR(c.max_distance_error, 0.01, 1e-4);
  EXPECT_NEAR(c.max_relative_distance_error, 1e-4, 1e-6);
  EXPECT_NEAR(c.max_normal_degrees, std::asin(0.1) * 180 / std::acos(-1.0), 1e-3);
  EXPECT_EQ(c.first.x, 1);
  EXPECT_EQ(c.first.y, 0);
  EXPECT_TRUE(c.first.a.hit());
  EXPECT_FALSE(c.first.b.hit());
}

TEST(Compare, APixelWithSeveralDifferencesIsOneDifferingPixel) {
  const Frame a = frame_of(1, 1);
  Frame b = a;
  b.at(0, 0) = {50, 9, {1, 0, 0}};
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.differing, 1u);
  EXPECT_EQ(c.id_differs + c.distance_differs + c.normal_differs, 3u);
}

TEST(Compare, DistancesWithinTheBoundAreEqualAndBeyondItAreNot) {
  const Frame a = frame_of(1, 1);
  Frame b = a;
  b.at(0, 0).distance = 100.0009f;
  EXPECT_TRUE(compare(a, b).equal());
  b.at(0, 0).distance = 100.0011f;
  EXPECT_FALSE(compare(a, b).equal());
  EXPECT_TRUE(compare(a, b, {.distance_relative = 2e-5}).equal());
}

TEST(Compare, TheFloorServesDistancesAroundZero) {
  Frame a = frame_of(1, 1), b = a;
  a.at(0, 0).distance = 1e-5f;
  b.at(0, 0).distance = -1e-5f;
  EXPECT_FALSE(compare(a, b).equal());
  EXPECT_TRUE(compare(a, b, {.distance_floor = 10}).equal());
}

TEST(Compare, WhatIsNoNumberDiffers) {
  const Frame a = frame_of(1, 1);
  Frame b = a;
  b.at(0, 0).distance = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(compare(a, b).distance_differs, 1u);
  EXPECT_EQ(compare(b, b).distance_differs, 1u);
  b = a;
  b.at(0, 0).normal.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(compare(a, b).normal_differs, 1u);
}

TEST(Compare, IgnoredPixelsDoNotCount) {
  const Frame a = frame_of(2, 2);
  Frame b = a;
  b.at(0, 1).id = 8;
  const std::array<uint8_t, 4> mask{0, 0, 1, 0};
  const Comparison c = compare(a, b, {}, mask);
  EXPECT_TRUE(c.equal());
  EXPECT_EQ(c.pixels, 3u);
  EXPECT_EQ(c.ignored, 1u);
  b.at(1, 1).id = 8;
  EXPECT_EQ(compare(a, b, {}, mask).id_differs, 1u);
}

TEST(Compare, FramesOfDifferentSizeAreNeverEqual) {
  const Comparison c = compare(frame_of(2, 3), frame_of(3, 2));
  EXPECT_FALSE(c.equal());
  EXPECT_EQ(c.differing, 0u);
  EXPECT_EQ(describe(c), "the frames differ in size: 2x3 and 3x2");
  EXPECT_TRUE(difference_picture(frame_of(2, 3), frame_of(3, 2)).rgba.empty());
}

TEST(Compare, TheDescriptionNamesTheFirstPixelAndBothFacts) {
  const Frame a = frame_of(10, 10);
  Frame b = a;
  b.at(7, 2).id = 12;
  b.at(8, 2) = Hit{};
  const std::string text = describe(compare(a, b));
  for (const char* part :
       {"2 of 100 pixels differ", "hit 1", "id 1", "(7, 2)", "a: id 3 at 100", "b: id 12 at 100"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
}

TEST(Compare, TheDifferencePictureShowsTheKind) {
  const Frame a = frame_of(6, 1);
  Frame b = a;
  b.at(0, 0) = Hit{};
  b.at(1, 0).id = 4;
  b.at(2, 0).distance = 1;
  b.at(3, 0).normal = {1, 0, 0};
  const std::array<uint8_t, 6> mask{0, 0, 0, 0, 0, 1};
  const Picture p = difference_picture(a, b, {}, mask);
  const auto color = [&](int x) { return Rgb8{p.at(x, 0)[0], p.at(x, 0)[1], p.at(x, 0)[2]}; };
  for (int x = 0; x < 6; ++x) {
    EXPECT_EQ(p.at(x, 0)[3], 255);
    for (int y = 0; y < x; ++y) EXPECT_NE(color(x), color(y));
  }
  EXPECT_EQ(color(4), (Rgb8{205, 205, 205}));
}

RC_GTEST_PROP(Compare, DoesNotDependOnTheOrder, ()) {
  const auto random_frame = [] {
    Frame f(3, 3);
    for (Hit& h : f.hits) {
      h.id = *rc::gen::inRange<uint32_t>(0, 3);
      h.distance = float(*rc::gen::inRange(1, 4));
      h.normal = normalize(Vec3f{1, float(*rc::gen::inRange(0, 3)), 0});
    }
    return f;
  };
  const Frame a = random_frame(), b = random_frame();
  const Comparison x = compare(a, b), y = compare(b, a);
  RC_ASSERT(x.differing == y.differing && x.hit_differs == y.hit_differs);
  RC_ASSERT(x.id_differs == y.id_differs && x.distance_differs == y.distance_differs);
  RC_ASSERT(x.normal_differs == y.normal_differs && x.max_distance_error == y.max_distance_error);
}

}  // namespace
}  // namespace whittle

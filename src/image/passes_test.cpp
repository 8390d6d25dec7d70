#include "image/passes.h"

#include <gtest/gtest.h>

#include <set>

namespace whittle {
namespace {

Hit hit_at(float distance, uint32_t id = 1, Vec3f normal = {0, 0, 1}) {
  return {distance, id, normal};
}

Rgb8 color_at(const Picture& p, int x) {
  EXPECT_EQ(p.at(x, 0)[3], 255);
  return {p.at(x, 0)[0], p.at(x, 0)[1], p.at(x, 0)[2]};
}

TEST(Passes, DepthRunsFromWhiteToDarkGreyAndLeavesTheBackgroundBlack) {
  Frame frame(4, 1);
  frame.at(0, 0) = hit_at(10);
  frame.at(1, 0) = hit_at(15);
  frame.at(2, 0) = hit_at(20);
  const Picture p = depth_pass(frame);
  EXPECT_EQ(color_at(p, 0), (Rgb8{255, 255, 255}));
  EXPECT_EQ(color_at(p, 1), (Rgb8{153, 153, 153}));
  EXPECT_EQ(color_at(p, 2), (Rgb8{51, 51, 51}));
  EXPECT_EQ(color_at(p, 3), (Rgb8{0, 0, 0}));
}

TEST(Passes, DepthOfOneDistanceIsWhite) {
  Frame frame(2, 1);
  frame.at(0, 0) = hit_at(-3);
  EXPECT_EQ(color_at(depth_pass(frame), 0), (Rgb8{255, 255, 255}));
  EXPECT_EQ(color_at(depth_pass(Frame(1, 1)), 0), (Rgb8{0, 0, 0}));
}

TEST(Passes, NormalsAreHalfPlusHalf) {
  Frame frame(3, 1);
  frame.at(0, 0) = hit_at(1, 1, {1, 0, -1});
  frame.at(1, 0) = hit_at(1, 1, {0, -1, 0});
  const Picture p = normal_pass(frame);
  EXPECT_EQ(color_at(p, 0), (Rgb8{255, 128, 0}));
  EXPECT_EQ(color_at(p, 1), (Rgb8{128, 0, 128}));
  EXPECT_EQ(color_at(p, 2), (Rgb8{0, 0, 0}));
}

TEST(Passes, IdsHaveDistinctColorsThatDependOnTheIdAlone) {
  Frame frame(1001, 1), reversed(1001, 1);
  for (int i = 0; i < 1001; ++i) {
    frame.at(i, 0) = hit_at(1, uint32_t(i));
    reversed.at(1000 - i, 0) = hit_at(float(i), uint32_t(i), {1, 0, 0});
  }
  const Picture p = id_pass(frame), q = id_pass(reversed);
  std::set<uint32_t> colors;
  for (int i = 0; i < 1001; ++i) {
    const Rgb8 c = color_at(p, i);
    EXPECT_EQ(c, color_at(q, 1000 - i));
    colors.insert(uint32_t(c.r) << 16 | uint32_t(c.g) << 8 | c.b);
  }
  EXPECT_GT(colors.size(), 995u);
}

TEST(Passes, IdsThatFollowOneAnotherAreEasyToTellApart) {
  Frame frame(256, 1);
  for (int i = 0; i < 256; ++i) frame.at(i, 0) = hit_at(1, uint32_t(i));
  const Picture p = id_pass(frame);
  for (int i = 1; i < 256; ++i) {
    const Rgb8 a = color_at(p, i - 1), b = color_at(p, i);
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 60) << i;
  }
}

}  // namespace
}  // namespace whittle

#include "viewer/frame_plan.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

constexpr int64_t kPixels = 1000 * 1000;

/// Makes all that is planned, if a ray of a draft and a pixel of the final picture take so long.
int finish(FramePlan& plan, double draft, double final) {
  int made = 0;
  for (; plan.next(); ++made) {
    const int scale = plan.next()->scale;
    plan.took((plan.next()->is_final ? final : draft) * double(kPixels) / (scale * scale));
  }
  return made;
}

TEST(FramePlanTest, EndsWithTheFinalPictureAndThenNothingIsDone) {
  FramePlan plan;
  EXPECT_EQ(plan.next(), std::nullopt);
  plan.restart(kPixels, true);
  FrameStep last;
  while (plan.next()) {
    last = *plan.next();
    plan.took(10);
  }
  EXPECT_EQ(last, (FrameStep{1, true}));
}

TEST(FramePlanTest, TheFirstPictureIsCoarse) {
  FramePlan plan;
  plan.restart(kPixels, false);
  EXPECT_EQ(plan.next(), (FrameStep{2, false}));
}

TEST(FramePlanTest, PicturesInMotionAreAsFineAsThereIsTime) {
  FramePlan plan;
  plan.restart(kPixels, true);
  finish(plan, 5e-6, 1e-4);
  plan.restart(kPixels, true);
  EXPECT_EQ(plan.next(), (FrameStep{1, false}));
  FramePlan slow;
  slow.restart(kPixels, true);
  finish(slow, 2e-4, 1e-3);
  slow.restart(kPixels, true);
  EXPECT_EQ(slow.next(), (FrameStep{4, false}));
}

TEST(FramePlanTest, ADisplayThatIsMuchTooSlowGetsTheCoarsest) {
  FramePlan plan;
  plan.restart(kPixels, true);
  finish(plan, 1, 10);
  plan.restart(kPixels, true);
  EXPECT_EQ(plan.next(), (FrameStep{12, false}));
}

TEST(FramePlanTest, DoesNotGoToAndFroBetweenTwoScales) {
  FramePlan plan;
  plan.restart(kPixels, true);
  // Just too slow for one ray a pixel.
  plan.took(4);
  plan.restart(kPixels, true);
  ASSERT_EQ(plan.next()->scale, 2);
  // Just fast enough for it.
  for (int i = 0; i < 20; ++i) {
    plan.took(3.1);
    plan.restart(kPixels, true);
    EXPECT_EQ(plan.next()->scale, 2);
  }
  for (int i = 0; i < 20; ++i) {
    plan.took(1.5);
    plan.restart(kPixels, true);
    if (plan.next()->scale == 1) break;
  }
  EXPECT_EQ(plan.next()->scale, 1);
}

TEST(FramePlanTest, WhatIsStillIsRefinedInSteps) {
  FramePlan plan;
  plan.restart(kPixels, true);
  EXPECT_EQ(finish(plan, 1e-4, 1e-3), 3);  // coarse, fine, final
}

TEST(FramePlanTest, WhereTheFinalPictureIsSoonThereTheLastOneStaysUntilThen) {
  FramePlan plan;
  plan.restart(kPixels, false);
  finish(plan, 1e-5, 2e-4);
  plan.restart(kPixels, false);
  EXPECT_EQ(plan.next(), (FrameStep{1, true}));
  plan.restart(kPixels, true);
  EXPECT_FALSE(plan.next()->is_final);
  plan.took(10);
  EXPECT_EQ(plan.next(), (FrameStep{1, true}));
}

}  // namespace
}  // namespace whittle

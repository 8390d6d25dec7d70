#include "viewer/gestures.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

constexpr PictureSize kSize{800, 600};
constexpr OrbitView kView{{0, 0, 0}, {90, 0, 0}, 50, 30, false};

std::optional<Vec3> nothing(double, double) {
  return std::nullopt;
}

TEST(GesturesTest, TheLeftButtonTurns) {
  Gestures gestures(1);
  gestures.press(MouseButton::kLeft, false, 100, 100);
  EXPECT_EQ(gestures.move(110, 120, kView, kSize, nothing), orbited(kView, 10, 20));
  EXPECT_TRUE(gestures.is_dragging());
  EXPECT_EQ(gestures.move(110, 120, kView, kSize, nothing), std::nullopt);
  EXPECT_EQ(gestures.release(MouseButton::kLeft, 110, 120, 1), std::nullopt);
  EXPECT_EQ(gestures.move(150, 150, kView, kSize, nothing), std::nullopt);
}

TEST(GesturesTest, AsFarOnAScreenWithManyPixels) {
  Gestures gestures(2);
  gestures.press(MouseButton::kLeft, false, 100, 100);
  EXPECT_EQ(gestures.move(120, 140, kView, kSize, nothing), orbited(kView, 10, 20));
}

TEST(GesturesTest, OtherButtonsMoveAndSoDoesShift) {
  for (const auto& [button, shift] :
       {std::pair{MouseButton::kRight, false}, std::pair{MouseButton::kMiddle, false},
        std::pair{MouseButton::kLeft, true}}) {
    Gestures gestures(1);
    gestures.press(button, shift, 100, 100);
    EXPECT_EQ(gestures.move(110, 120, kView, kSize, nothing), panned(kView, kSize, 10, 20, 50));
    EXPECT_EQ(gestures.release(button, 110, 120, 1), std::nullopt);
  }
}

TEST(GesturesTest, WhatIsGrabbedFollows) {
  Gestures gestures(1);
  gestures.press(MouseButton::kRight, false, 100, 100);
  const auto near = [](double x, double y) {
    EXPECT_EQ(x, 100);
    EXPECT_EQ(y, 100);
    return std::optional(Vec3{3, -20, 4});
  };
  EXPECT_EQ(gestures.move(110, 120, kView, kSize, near), panned(kView, kSize, 10, 20, 30));
}

TEST(GesturesTest, AHandThatClicksMayShake) {
  Gestures gestures(1);
  gestures.press(MouseButton::kLeft, false, 100, 100);
  EXPECT_EQ(gestures.move(102, 101, kView, kSize, nothing), std::nullopt);
  const std::optional<Click> click = gestures.release(MouseButton::kLeft, 102, 101, 1);
  ASSERT_TRUE(click);
  EXPECT_EQ(click->x, 102);
  EXPECT_FALSE(click->is_double);
}

TEST(GesturesTest, TwoClicksSoonAfterOneAnotherAreOne) {
  Gestures gestures(1);
  const auto click = [&](double x, double seconds) {
    gestures.press(MouseButton::kLeft, false, x, 100);
    const std::optional<Click> made = gestures.release(MouseButton::kLeft, x, 100, seconds);
    return made && made->is_double;
  };
  EXPECT_FALSE(click(100, 1));
  EXPECT_TRUE(click(101, 1.2));
  EXPECT_FALSE(click(101, 1.3));  // the third is the first again
  EXPECT_FALSE(click(101, 2));    // too late
  EXPECT_FALSE(click(150, 2.1));  // elsewhere
}

TEST(GesturesTest, OneButtonAtATime) {
  Gestures gestures(1);
  gestures.press(MouseButton::kLeft, false, 100, 100);
  gestures.press(MouseButton::kRight, false, 100, 100);
  EXPECT_EQ(gestures.release(MouseButton::kRight, 100, 100, 1), std::nullopt);
  EXPECT_EQ(gestures.move(110, 120, kView, kSize, nothing), orbited(kView, 10, 20));
}

TEST(GesturesTest, TheWheelZoomsToWhatIsUnderTheMouse) {
  const Vec3 p{3, -20, 4};
  const auto seen = [&](double, double) { return std::optional(p); };
  EXPECT_EQ(Gestures::wheel(2, 100, 100, kView, kSize, seen), zoomed(kView, wheel_factor(2), p));
  EXPECT_EQ(Gestures::wheel(2, 100, 100, kView, kSize, nothing),
            zoomed(kView, wheel_factor(2), point_on_target_plane(kView, kSize, 100, 100)));
}

}  // namespace
}  // namespace whittle

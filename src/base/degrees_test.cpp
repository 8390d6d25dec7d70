#include "base/degrees.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace whittle {
namespace {

TEST(Degrees, ExactWhereKnown) {
  for (const double turn : {-720.0, 0.0, 360.0}) {
    EXPECT_EQ(sin_degrees(turn + 30), 0.5);
    EXPECT_EQ(sin_degrees(turn + 210), -0.5);
    EXPECT_EQ(cos_degrees(turn + 60), 0.5);
    EXPECT_EQ(cos_degrees(turn + 90), 0.0);
    EXPECT_EQ(cos_degrees(turn + 270), 0.0);
    EXPECT_EQ(cos_degrees(turn + 180), -1.0);
    EXPECT_EQ(sin_degrees(turn + 180), 0.0);
    EXPECT_EQ(sin_degrees(turn + 45), cos_degrees(turn + 45));
    EXPECT_EQ(sin_degrees(turn + 120), std::numbers::sqrt3 / 2);
  }
}

TEST(Degrees, AgreeWithRadians) {
  EXPECT_TRUE(rc::check([] {
    const double degrees = *rc::gen::inRange(-100000000, 100000000) / 1e5;
    RC_ASSERT(std::fabs(sin_degrees(degrees) - std::sin(degrees * std::numbers::pi / 180)) < 1e-12);
    RC_ASSERT(std::fabs(cos_degrees(degrees) - std::cos(degrees * std::numbers::pi / 180)) < 1e-12);
  }));
}

}  // namespace
}  // namespace whittle

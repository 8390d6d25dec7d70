#include "image/feature_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/scene_for_test.h"

namespace whittle {
namespace {

/// From above, 1 pixel a unit. Spots next to one another, of given height and slope.
const Camera kCamera = camera_from_above(20, 20);

Spot spot(float x, uint32_t id, float z = 0, double degrees = 0) {
  const double angle = degrees * std::acos(-1.0) / 180;
  const Hit hit{50 - z, id, {float(std::sin(angle)), 0, float(std::cos(angle))}};
  return {kCamera, {x, 10}, id == 0 ? Hit{} : hit};
}

TEST(FeatureLines, ThereAreNoneWithinAFace) {
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 1)), 0);
  EXPECT_EQ(line_between(spot(10, 0), spot(11, 0)), 0) << "nor in empty space";
}

TEST(FeatureLines, FlushFacesOfTwoPrimitivesAreOne) {
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 2)), 0);
}

TEST(FeatureLines, ASilhouetteHasAFullOne) {
  EXPECT_EQ(line_between(spot(10, 0), spot(11, 1)), 1);
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 0)), 1);
}

TEST(FeatureLines, FacesOfEqualNormalAtAnotherDepthDoNotMerge) {
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 1, 5)), 1) << "a floor and its rim";
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 2, 5)), 1);
  EXPECT_EQ(line_between(spot(10, 1), spot(11, 1, 0.5f)), 0) << "less than a pixel";
}

TEST(FeatureLines, ACreaseHasOneAndFacetsOfACurveHaveNone) {
  EXPECT_GT(line_between(spot(10, 1, 0, -45), spot(10.1f, 1, 0, 45)), 0.7f);
  EXPECT_GT(line_between(spot(10, 1, 0, 0), spot(10.1f, 2, 0, 30)), 0.7f);
  EXPECT_EQ(line_between(spot(10, 1, 0, 0), spot(10.1f, 1, 0, 12)), 0) << "$fn = 30";
}

TEST(FeatureLines, ASteepFaceIsNoStep) {
  // 80 degrees: between pixels the height changes by almost six.
  const double rise = std::tan(80 / 180.0 * std::acos(-1.0));
  EXPECT_EQ(line_between(spot(10, 1, 0, 80), spot(11, 1, float(-rise), 80)), 0);
  EXPECT_LT(pixels_apart(spot(10, 1, 0, 80), spot(11, 1, float(-rise), 80)), 0.01f);
}

}  // namespace
}  // namespace whittle

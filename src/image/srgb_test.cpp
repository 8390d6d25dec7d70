#include "image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whittle {
namespace {

TEST(Srgb, KnownValues) {
  EXPECT_EQ(linear_from_srgb(0), 0);
  EXPECT_FLOAT_EQ(linear_from_srgb(1), 1);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.214041f, 1e-6f);
  EXPECT_NEAR(srgb_from_linear(0.214041f), 0.5f, 1e-6f);
}

/// Linear light 0..1 by the table.
int encoded(float linear) {
  return srgb_table()[size_t(linear * kSrgbSteps + 0.5f)];
}

TEST(Srgb, EncodingAnEncodedByteGivesItBack) {
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(encoded(linear_from_srgb(float(i) / 255)), i);
  }
}

TEST(Srgb, TableIsWithinALevelOfTheCurveAndMostlyOnIt) {
  constexpr int kSamples = 100'000;
  int off = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const float v = float(i) / kSamples;
    const int exact = int(std::lround(srgb_from_linear(v) * 255));
    const int got = encoded(v);
    ASSERT_LE(std::abs(exact - got), 1) << v;
    off += exact != got;
  }
  EXPECT_LT(off, kSamples / 50);
}

}  // namespace
}  // namespace whittle

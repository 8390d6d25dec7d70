#include "shape/fragments.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace whittle {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

TEST(Fragments, FollowOpenScadsRule) {
  EXPECT_EQ(fragments(10, {.fn = 8}), 8);
  EXPECT_EQ(fragments(10, {.fn = 1}), 3);
  EXPECT_EQ(fragments(10, {.fn = 7.2}), 8) << "fractions round up";
  EXPECT_EQ(fragments(10, {.fn = 0, .fa = 12, .fs = 2}), 30) << "$fa decides";
  EXPECT_EQ(fragments(5, {.fn = 0, .fa = 12, .fs = 2}), 16) << "$fs decides: ceil(10 pi / 2)";
  EXPECT_EQ(fragments(0.5, {.fn = 0, .fa = 12, .fs = 2}), 5) << "never below 5";
  EXPECT_EQ(fragments(10, {.fn = -4, .fa = 12, .fs = 2}), 30) << "negative $fn is none";
}

TEST(Fragments, SurviveAnyNumbers) {
  EXPECT_EQ(fragments(1e-7, {.fn = 100}), 3) << "below OpenSCAD's smallest length";
  EXPECT_EQ(fragments(10, {.fn = kEndless}), 3);
  EXPECT_EQ(fragments(10, {.fn = kNotANumber}), 3);
  EXPECT_EQ(fragments(10, {.fn = 1e300}), std::numeric_limits<int>::max());
  EXPECT_EQ(fragments(1e300, {.fn = 0, .fa = 1e-300, .fs = 0}), 36000) << "$fa is at least 0.01";
}

TEST(ChooseFacets, HonoursTheChoice) {
  const FragmentSettings eight{.fn = 8}, none{.fn = 0};
  EXPECT_EQ(choose_facets(10, eight, Curves::kAuto), 8);
  EXPECT_EQ(choose_facets(10, none, Curves::kAuto), 0);
  EXPECT_EQ(choose_facets(10, none, Curves::kFacets), 30);
  EXPECT_EQ(choose_facets(10, eight, Curves::kSmooth), 0);
  EXPECT_EQ(choose_facets(10, none, Curves::kOpenscad2021), 30);
  EXPECT_EQ(choose_facets(10, {.fn = 1e9}, Curves::kAuto), 0) << "finer than the tolerance";
}

TEST(ChooseFacets, CutsOffFractionsAsOpenscad2021Does) {
  const double kFn[] = {0.5, 2.9, 3.2, 4.7, 4.999, 5.0001, 7.5, kEndless, kNotANumber};
  const int kCutOff[] = {3, 3, 3, 4, 4, 5, 7, 3, 3}, kRoundedUp[] = {3, 3, 4, 5, 5, 6, 8, 3, 3};
  for (size_t i = 0; i < std::size(kFn); ++i) {
    EXPECT_EQ(choose_facets(3, {.fn = kFn[i]}, Curves::kOpenscad2021), kCutOff[i]) << kFn[i];
    EXPECT_EQ(choose_facets(3, {.fn = kFn[i]}, Curves::kFacets), kRoundedUp[i]) << kFn[i];
  }
}

}  // namespace
}  // namespace whittle

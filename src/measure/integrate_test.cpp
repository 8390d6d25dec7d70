#include "measure/integrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "lower/lower.h"
#include "measure/graph_patch.h"
#include "measure/truth.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

constexpr double kPi = std::numbers::pi;

Integrated integral_of(const std::string& text, double within = 1e-6, int threads = 2) {
  const Scene scene = *lower(model_of(text));
  IntegrateSettings settings;
  settings.within = within;
  return integrate(scene, Workers(threads), settings);
}

/// No answer may be farther off than it says, and it must say little enough. Rounding is of `size`.
void expect_measures(const std::string& text, double volume, double area, double size = 1) {
  for (const double within : {1e-3, 1e-6}) {
    const Integrated found = integral_of(text, within);
    const Integral& integral = found.integral;
    EXPECT_TRUE(found.is_within) << text;
    EXPECT_LE(integral.bound(kVolume), within * volume) << text;
    EXPECT_LE(std::fabs(integral[kVolume] - volume), integral.bound(kVolume)) << text;
    EXPECT_LE(std::fabs(integral[kArea] - area),
              integral.bound(kArea) + 1e-13 * size * size + 1e-14 * area)
        << text;
  }
  EXPECT_LE(integral_of(text, 1e-6).integral.bound(kArea), 1e-3 * area) << text;
}

std::string moved_by(const std::string& x, const std::string& text) {
  return "multmatrix([[1,0,0," + x + "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { " + text + " }";
}

/// Turned about y by a quarter.
std::string lying(const std::string& text) {
  return "multmatrix([[0,0,1,0],[0,1,0,0],[-1,0,0,0],[0,0,0,1]]) { " + text + " }";
}

const std::string kPipe = "cylinder(h = 4, r1 = 1, r2 = 1, center = true);";

TEST(Integrate, EndsWhereAVolumeIsTooSmallForANumber) {
  const Scene scene = *lower(model_of("sphere(r = 1e-110);"));
  IntegrateSettings settings;
  settings.most_parts = 1000;
  const Integrated found = integrate(scene, Workers(1), settings);
  EXPECT_EQ(found.integral[kVolume], 0);
}

TEST(Integrate, Cube) {
  expect_measures("cube(size = [1, 2, 3]);", 6, 22);
}

TEST(Integrate, Sphere) {
  expect_measures("sphere(r = 1);", 4 * kPi / 3, 4 * kPi);
  expect_measures(moved_by("1000", "sphere(r = 1);"), 4 * kPi / 3, 4 * kPi, 1000);
}

TEST(Integrate, CylinderAndCones) {
  expect_measures("cylinder(h = 2, r1 = 1, r2 = 1);", 2 * kPi, 6 * kPi);
  expect_measures("cylinder(h = 1, r1 = 1, r2 = 0);", kPi / 3, kPi * (1 + std::sqrt(2)));
  expect_measures("cylinder(h = 2, r1 = 2, r2 = 1);", 2 * kPi / 3 * 7,
                  kPi * (5 + 3 * std::sqrt(5)));
  // Aslant: turned about y by 30 degrees.
  expect_measures(
      "multmatrix([[0.8660254037844387,0,0.5,0],[0,1,0,0],[-0.5,0,0.8660254037844387,0],[0,0,0,1]])"
      "cylinder(h = 2, r1 = 1, r2 = 1);",
      2 * kPi, 6 * kPi);
}

TEST(Integrate, Steinmetz) {
  expect_measures("intersection() {" + kPipe + lying(kPipe) + "}", 16.0 / 3, 16);
  expect_measures("union() {" + kPipe + lying(kPipe) + "}", 8 * kPi - 16.0 / 3,
                  2 * (8 * kPi + 2 * kPi) - 16);
}

TEST(Integrate, DrilledPlate) {
  const std::string drill = moved_by("0.5", kPipe);
  expect_measures("difference() { cube(size = [8, 8, 1], center = true);" + drill + "}", 64 - kPi,
                  128 + 32 - 2 * kPi + 2 * kPi);
}

TEST(Integrate, LensAndBite) {
  // Two unit balls at a distance of 1: caps of height 1/2.
  const double cap = kPi * 0.25 * 2.5 / 3, cap_area = kPi;
  const std::string two = "sphere(r = 1); " + moved_by("1", "sphere(r = 1);");
  expect_measures("intersection() {" + two + "}", 2 * cap, 2 * cap_area);
  expect_measures("difference() {" + two + "}", 4 * kPi / 3 - 2 * cap, 4 * kPi);
  expect_measures("union() {" + two + "}", 8 * kPi / 3 - 2 * cap, 8 * kPi - 2 * cap_area);
}

/// The ball sits in the end of the pipe, and touches its wall along a circle.
TEST(Integrate, SurfacesThatTouch) {
  expect_measures("union() {" + kPipe +
                      "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,2],[0,0,0,1]]) sphere(r = 1); }",
                  4 * kPi + 2 * kPi / 3, kPi + 8 * kPi + 2 * kPi);
}

TEST(Integrate, Squashed) {
  expect_measures("multmatrix([[3,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) sphere(r = 1);", 4 * kPi,
                  2 * kPi * (1 + 3 * std::asin(std::sqrt(8.0) / 3) / (std::sqrt(8.0) / 3)));
}

TEST(Integrate, NothingIsNothing) {
  const Integrated found = integral_of("difference() { sphere(r = 1); sphere(r = 2); }");
  EXPECT_LE(std::fabs(found.integral[kVolume]), found.integral.bound(kVolume));
  EXPECT_LT(found.integral.bound(kVolume), 1e-9);
}

TEST(Integrate, SaysWhatItReachesWithFewParts) {
  const Scene scene = *lower(model_of("sphere(r = 1);"));
  IntegrateSettings settings;
  settings.within = 1e-9;
  settings.most_parts = 20'000;
  const Integrated found = integrate(scene, Workers(2), settings);
  EXPECT_FALSE(found.is_within);
  EXPECT_LE(found.parts, settings.most_parts);
  EXPECT_LE(std::fabs(found.integral[kVolume] - 4 * kPi / 3), found.integral.bound(kVolume));
  EXPECT_LT(found.integral.bound(kVolume), 0.1);
}

TEST(Integrate, TheSameOnAnyNumberOfThreads) {
  const std::string text = random_tree(7);
  const Integrated one = integral_of(text, 1e-3, 1), four = integral_of(text, 1e-3, 4);
  EXPECT_EQ(one.parts, four.parts);
  for (size_t m = 0; m < kMomentCount; ++m) {
    EXPECT_EQ(one.integral[m], four.integral[m]);
    EXPECT_EQ(one.integral.bound(m), four.integral.bound(m));
  }
}

/// Bounds that were not true would part: what is found roughly and what is found well must agree.
TEST(Integrate, BoundsOfRandomTreesOverlap) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    const std::string text = random_tree(seed, {.primitives = 8, .coincident = seed % 2 == 0});
    const Integrated rough = integral_of(text, 3e-2), fine = integral_of(text, 1e-4);
    for (size_t m = 0; m < kMomentCount; ++m)
      EXPECT_LE(std::fabs(rough.integral[m] - fine.integral[m]),
                rough.integral.bound(m) + fine.integral.bound(m) + 1e-12)
          << "seed " << seed << ", moment " << m;
  }
}

TEST(GaussRule, IsExactForPolynomials) {
  for (size_t n = 1; n <= GaussRule::kMost; ++n) {
    const GaussRule rule = gauss_rule(n);
    for (size_t degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (size_t i = 0; i < n; ++i) sum += rule.weight[i] * std::pow(rule.at[i], double(degree));
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2 / double(degree + 1) : 0, 1e-14);
    }
  }
}

/// 1 / (x - a) is analytic in all ellipses that a is outside of.
TEST(GaussRule, ErrorsAreBounds) {
  for (size_t n = 1; n <= GaussRule::kMost; ++n) {
    const GaussRule rule = gauss_rule(n);
    for (const double rho : kEllipses) {
      const double reach = ellipse_reach(rho);
      const double a = reach * 1.01;
      double sum = 0;
      for (size_t i = 0; i < n; ++i) sum += rule.weight[i] / (a - rule.at[i]);
      EXPECT_LE(std::fabs(sum - std::log((a + 1) / (a - 1))),
                gauss_error(n, rho) / (a - reach) + 1e-13);
    }
  }
}

TEST(Truth, CofactorsAndMonotony) {
  const uint64_t both = full_table(0b1000, 2), either = full_table(0b1110, 2);
  const uint64_t one = full_table(0b0110, 2);
  EXPECT_EQ(cofactor(both, 0, true), full_table(0b1100, 2));
  EXPECT_EQ(cofactor(both, 0, false), 0u);
  EXPECT_EQ(cofactor(either, 1, true), ~uint64_t(0));
  EXPECT_TRUE(is_monotone(both, 0) && is_monotone(either, 1));
  EXPECT_FALSE(is_monotone(one, 0) || is_monotone(one, 1));
}

}  // namespace
}  // namespace whittle

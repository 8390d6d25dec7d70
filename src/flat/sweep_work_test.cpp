#include "flat/sweep_work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace whittle {
namespace {

/// Thin bars across one another; each two cross in four places.
std::vector<Contour> grille(int n) {
  std::vector<Contour> bars;
  for (int i = 0; i < n; ++i) {
    const double at = 2 * i, end = 2 * n;
    bars.push_back({{at, -1}, {at + 1, -1}, {at + 1, end}, {at, end}});
    bars.push_back({{-1, at}, {end, at}, {end, at + 1}, {-1, at + 1}});
  }
  return bars;
}

TEST(SweepWork, OfFewEdgesIsExact) {
  EXPECT_EQ(estimate_sweep_work({}), 0u);
  // A level line meets both sides of a bar, or three or four sides of both.
  EXPECT_EQ(estimate_sweep_work(grille(1)), 6u + 4 * 2500);
}

TEST(SweepWork, OfManyEdgesIsEstimated) {
  for (const int bars : {50, 100, 400}) {
    const double crossings = 4.0 * bars * bars;
    EXPECT_NEAR(double(estimate_sweep_work(grille(bars))), 2500 * crossings, 200 * crossings);
  }
  // A comb: nothing crosses, but a level line meets all.
  Contour comb;
  for (int i = 0; i < 50'000; ++i) comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1.0});
  comb.insert(comb.end(), {{49'999, -1}, {0, -1}});
  EXPECT_NEAR(double(estimate_sweep_work(std::span(&comb, 1))), 50'000.0 * 50'000 / 2, 1e6);
}

TEST(SweepWork, OfRandomCornersIsTooMuch) {
  std::minstd_rand random;
  Contour tangle;
  for (int i = 0; i < 1000; ++i) tangle.push_back({double(random()), double(random())});
  EXPECT_GT(estimate_sweep_work(std::span(&tangle, 1)), kMostSweepWork);
  tangle.resize(100);
  EXPECT_LT(estimate_sweep_work(std::span(&tangle, 1)), kMostSweepWork / 20);
}

TEST(SweepWork, OfALongOutlineIsSmall) {
  Contour ring;
  for (int i = 0; i < 200'000; ++i) {
    const double angle = i * std::numbers::pi / 100'000, r = 10 + std::sin(50 * angle);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  EXPECT_LT(estimate_sweep_work(std::span(&ring, 1)), kMostSweepWork / 20);
}

}  // namespace
}  // namespace whittle

#include "slice/pixel_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace whittle {
namespace {

/// Rows one after another, zeros where none came.
std::vector<double> covered(const std::vector<Contour>& loops, const PixelFrame& frame) {
  std::vector<double> pixels(size_t(frame.width) * size_t(frame.height));
  int last = -1;
  cover_pixels(loops, frame, [&](int y, std::span<const double> shares) {
    EXPECT_GT(y, last);
    last = y;
    EXPECT_EQ(shares.size(), size_t(frame.width));
    std::ranges::copy(shares, pixels.begin() + std::ptrdiff_t(y) * frame.width);
  });
  return pixels;
}

double sum(const std::vector<double>& values) {
  double all = 0;
  for (const double value : values) all += value;
  return all;
}

Contour rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

PixelFrame pixels(int width, int height) {
  return {width, height, {0, double(height)}, 1};
}

TEST(PixelCoverage, IsTheShareOfEveryPixel) {
  // From the upper left: a quarter of the first, half of the second, a quarter of the third.
  EXPECT_EQ(covered({rectangle(0.75, 1.5, 2.25, 2)}, pixels(3, 2)),
            (std::vector<double>{0.125, 0.5, 0.125, 0, 0, 0}));
  EXPECT_EQ(covered({{{0, 0}, {2, 0}, {0, 2}}}, pixels(2, 2)),
            (std::vector<double>{0.5, 0, 1, 0.5}));
  EXPECT_EQ(covered({}, pixels(2, 1)), (std::vector<double>{0, 0}));
}

TEST(PixelCoverage, AddsUpToTheArea) {
  const Contour outside = circle(40, 100);
  Contour hole = circle(17.3, 7);
  std::ranges::reverse(hole);
  const auto area_of = [](double r, int n) {
    return n / 2.0 * r * r * std::sin(2 * std::numbers::pi / n);
  };
  for (const double pixel : {0.31, 1.0, 7.7}) {
    const PixelFrame frame = frame_around({{-41, -41}, {41, 41}}, 300, 280, pixel);
    const std::vector<double> shares = covered({outside, hole}, frame);
    EXPECT_NEAR(sum(shares) * pixel * pixel, area_of(40, 100) - area_of(17.3, 7), 1e-9) << pixel;
  }
}

TEST(PixelCoverage, LeavesOutWhatIsOutside) {
  const std::vector<Contour> all = {{{-5, -5}, {9, -4}, {8, 11}, {-6, 7}}};
  EXPECT_NEAR(sum(covered(all, pixels(3, 4))), 12, 1e-12);
  EXPECT_EQ(covered({rectangle(-9, 0.5, 0.5, 9)}, pixels(2, 1)), (std::vector<double>{0.25, 0}));
  EXPECT_EQ(covered({rectangle(1.5, 0, 9, 1)}, pixels(2, 1)), (std::vector<double>{0, 0.5}));
  for (const Contour& beside : {rectangle(-9, 0, -1, 1), rectangle(5, 0, 9, 1),
                                rectangle(0, 2, 1, 3), rectangle(0, -3, 1, -1)})
    EXPECT_EQ(sum(covered({beside}, pixels(2, 1))), 0);
  // A side that crosses the left edge within one row.
  EXPECT_NEAR(sum(covered({{{-1, 0}, {1, 0}, {1, 1}}}, pixels(2, 1))), 0.75, 1e-15);
}

TEST(PixelCoverage, OfWhatIsBeyondNumbersEndsWell) {
  constexpr double kHuge = 1e300, kNone = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(sum(covered({rectangle(-kHuge, -kHuge, kHuge, kHuge)}, pixels(4, 3))), 12, 1e-9);
  covered({rectangle(-kNone, -kNone, kNone, kNone), rectangle(0, 0, std::nan(""), 1)},
          pixels(4, 3));
}

TEST(PixelCoverage, TheFrameIsAroundTheBox) {
  const PixelFrame fit = frame_around({{10, 20}, {30, 25}}, 40, 20, 0);
  EXPECT_EQ(fit.pixel, 0.5);
  EXPECT_EQ(fit.corner, (Vec2{10, 27.5}));
  const PixelFrame high = frame_around({{0, 0}, {1, 10}}, 40, 20, 0);
  EXPECT_EQ(high.pixel, 0.5);
  EXPECT_EQ(high.corner, (Vec2{-9.5, 10}));
  const PixelFrame given = frame_around({{10, 20}, {30, 25}}, 40, 20, 1);
  EXPECT_EQ(given.pixel, 1);
  EXPECT_EQ(given.corner, (Vec2{0, 32.5}));
  EXPECT_EQ(frame_around({{3, 3}, {3, 3}}, 2, 2, 0).pixel, 1) << "there must be some size";
}

}  // namespace
}  // namespace whittle

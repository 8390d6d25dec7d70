#include "image/directions.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace whittle {
namespace {

TEST(Directions, EveryBlockHasEachOnce) {
  std::set<uint32_t> found;
  for (size_t y = 0; y < kDirectionBlock; ++y)
    for (size_t x = 0; x < kDirectionBlock; ++x) found.insert(direction_of_pixel(x, y));
  EXPECT_EQ(found.size(), kBlockDirections);
  EXPECT_EQ(*found.rbegin(), kBlockDirections - 1);
}

/// The parts that some points fall into, of the unit square cut into columns and rows.
std::set<std::pair<int, int>> parts_hit(const std::vector<Vec2>& points, int columns, int rows) {
  std::set<std::pair<int, int>> parts;
  for (const Vec2 p : points) parts.insert({int(p.x * columns), int(p.y * rows)});
  return parts;
}

TEST(Directions, BlocksOfEverySizeAreSpreadEvenly) {
  for (const size_t side : {size_t(2), size_t(4), size_t(8)}) {
    for (size_t y0 = 0; y0 < kDirectionBlock; y0 += side) {
      for (size_t x0 = 0; x0 < kDirectionBlock; x0 += side) {
        std::vector<Vec2> points;
        for (size_t y = y0; y < y0 + side; ++y)
          for (size_t x = x0; x < x0 + side; ++x)
            points.push_back(spread_point(direction_of_pixel(x, y), kBlockDirections));
        const int n = int(side * side);
        for (int columns = 1; columns <= n; columns *= 2)
          EXPECT_EQ(parts_hit(points, columns, n / columns).size(), size_t(n))
              << side << " from " << x0 << ", " << y0;
      }
    }
  }
}

TEST(Directions, FallAsOftenAsTheirCosineIsLarge) {
  constexpr uint32_t kCount = 1024;
  const Axes axes(normalize(Vec3{1, -2, 3}));
  double mean = 0, below_half = 0;
  for (uint32_t i = 0; i < kCount; ++i) {
    const double cosine = dot(axes.over(on_disc(spread_point(i, kCount))), axes.z);
    mean += cosine / kCount;
    below_half += (cosine < 0.5) / double(kCount);
  }
  EXPECT_NEAR(mean, 2.0 / 3, 0.002);
  EXPECT_NEAR(below_half, 0.25, 0.002);
}

RC_GTEST_PROP(Directions, AxesAreUnitAndAtRightAngles, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const Vec3 v{number(), number(), number()};
  RC_PRE(length(v) > 0);
  const Axes axes(normalize(v));
  for (const Vec3 axis : {axes.x, axes.y, axes.z}) RC_ASSERT(std::fabs(length(axis) - 1) < 1e-12);
  RC_ASSERT(length(cross(axes.x, axes.y) - axes.z) < 1e-12);
}

}  // namespace
}  // namespace whittle

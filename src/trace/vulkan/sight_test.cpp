// What is solved is said to be only where all of it is.
#include "trace/vulkan/sight.h"

#include <gtest/gtest.h>

#include <random>

namespace whittle {
namespace {

TEST(SolvedPixels, HoldsARectangleOnlyIfAllOfItIsSolved) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  int held = 0, not_held = 0;
  for (int round = 0; round < 200; ++round) {
    const int width = 1 + below(60), height = 1 + below(40);
    std::vector<uint32_t> seen(size_t(width * height), 7);
    for (int open = below(4); open > 0; --open) seen[size_t(below(width * height))] = 0;
    const SolvedPixels solved(seen, width, height);
    for (int i = 0; i < 50; ++i) {
      PixelRect rect{below(width + 1), below(height + 1), below(width + 1), below(height + 1)};
      if (rect.x0 > rect.x1) std::swap(rect.x0, rect.x1);
      if (rect.y0 > rect.y1) std::swap(rect.y0, rect.y1);
      bool all = true;
      for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) all = all && seen[size_t(y * width + x)] != 0;
      if (solved.holds(rect)) {
        EXPECT_TRUE(all);
        ++held;
      } else {
        ++not_held;
      }
    }
  }
  EXPECT_GT(held, 500);
  EXPECT_GT(not_held, 500);
}

TEST(SolvedPixels, AllOrNothing) {
  const std::vector<uint32_t> none(20 * 10, 0), all(20 * 10, 1);
  EXPECT_FALSE(SolvedPixels(none, 20, 10).holds({3, 3, 4, 4}));
  EXPECT_TRUE(SolvedPixels(none, 20, 10).holds({3, 3, 3, 9})) << "there is nothing in it";
  EXPECT_TRUE(SolvedPixels(all, 20, 10).holds({0, 0, 20, 10}));
}

}  // namespace
}  // namespace whittle

#include "lines/split_lines.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

const Workers kSplitThreads(2);
const Projection kAbove = [] {
  Camera camera;
  camera.up = {0, 1, 0}, camera.forward = {0, 0, -1};
  camera.orthographic = true;
  return Projection(camera, 1, 10);
}();

DrawnLine line(Vec3 from, Vec3 to) {
  return *kAbove.draw(from, to);
}

std::vector<double> cuts(const std::vector<DrawnLine>& covering) {
  const std::vector<DrawnLine> lines = {line({0, 0, 0}, {10, 0, 0})};
  std::vector<double> places;
  const auto parts = split_lines(lines, covering, kAbove, 1e-3, kSplitThreads);
  EXPECT_TRUE(parts);
  if (!parts) return {};
  for (const LinePart& part : *parts) places.push_back(part.to);
  return places;
}

TEST(SplitLines, CutsWhereALineIsBefore) {
  EXPECT_EQ(cuts({line({3, -1, 2}, {3, 1, 2})}), (std::vector<double>{0.3, 1}));
  EXPECT_EQ(cuts({line({3, -1, -2}, {3, 1, -2})}), (std::vector<double>{1}));
  EXPECT_EQ(cuts({line({3, 1, 2}, {3, 2, 2})}), (std::vector<double>{1}));
  // Two that go on from one another right on the line; ends on it; one that lies on it.
  EXPECT_EQ(cuts({line({4, -1, 2}, {5, 0, 2}), line({5, 0, 2}, {6, 1, 2})}),
            (std::vector<double>{0.5, 1}));
  EXPECT_EQ(cuts({line({2, 0, 2}, {6, 0, 2})}), (std::vector<double>{0.2, 0.6, 1}));
}

TEST(SplitLines, LeavesNoShortParts) {
  EXPECT_EQ(cuts({line({1e-6, -1, 2}, {1e-6, 1, 2}), line({5, -1, 2}, {5, 1, 2}),
                  line({5 + 1e-6, -1, 2}, {5 + 1e-6, 1, 2})})
                .size(),
            2u);
}

}  // namespace
}  // namespace whittle

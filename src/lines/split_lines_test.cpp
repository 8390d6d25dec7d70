#include "lines/split_lines.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

const Workers kSplitThreads(2);
const ViewProjection kAbove = [] {
  Camera camera;
  camera.up = {0, 1, 0}, camera.forward = {0, 0, -1};
  camera.orthographic = true;
  return ViewProjection(camera, 1, 10);
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

TEST(SplitLines, PassesNoLimit) {
  // Discs on one another, seen from above: the lines lie on one another, too.
  std::vector<DrawnLine> pile;
  for (int i = 0; i < 1000; ++i) pile.push_back(line({0, 0, i + 0.0}, {10, 1, i + 0.0}));
  EXPECT_TRUE(split_lines(pile, pile, kAbove, 1e-3, kSplitThreads));
  const auto close = split_lines(pile, pile, kAbove, 1e-3, kSplitThreads, {.pairs = 500'000});
  ASSERT_FALSE(close);
  EXPECT_EQ(close.error().kind, ErrorKind::kMachine);
  EXPECT_EQ(close.error().message, "too many lines of the drawing run close to one another");
}

TEST(SplitLines, CountsThePartsOfAllLines) {
  std::vector<DrawnLine> lines, across;
  for (int i = 0; i < 300; ++i) lines.push_back(line({0, i + 0.0, 0}, {10, i + 0.0, 0}));
  for (int i = 1; i < 10; ++i) across.push_back(line({i + 0.0, -1, 2}, {i + 0.0, 300, 2}));
  const auto parts = split_lines(lines, across, kAbove, 1e-3, kSplitThreads, {.parts = 3000});
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->size(), 3000u);
  const auto many = split_lines(lines, across, kAbove, 1e-3, kSplitThreads, {.parts = 2999});
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().message, "the lines of the drawing cross too often");
}

}  // namespace
}  // namespace whittle

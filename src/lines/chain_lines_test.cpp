#include "lines/chain_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whittle {
namespace {

KindLine edge(Vec2 a, Vec2 b) {
  return {{a, b}, LineKind::kEdge};
}

TEST(ChainLines, GoOnWhereTwoMeet) {
  const std::vector<KindLine> lines = {edge({0, 0}, {1, 0}), edge({2, 1}, {1, 0}),
                                       edge({2, 1}, {2, 2})};
  const auto paths = chain_lines(lines, 0.01);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].points.size(), 4u);
  EXPECT_FALSE(paths[0].is_closed);
}

TEST(ChainLines, EndWhereThreeMeetAndWhereKindsChange) {
  const std::vector<KindLine> three = {edge({0, 0}, {1, 0}), edge({0, 0}, {0, 1}),
                                       edge({0, 0}, {-1, 0})};
  EXPECT_EQ(chain_lines(three, 0.01).size(), 3u);
  const std::vector<KindLine> kinds = {edge({0, 0}, {1, 0}), {{{1, 0}, {2, 0}}, LineKind::kHidden}};
  EXPECT_EQ(chain_lines(kinds, 0.01).size(), 2u);
}

TEST(ChainLines, RingsCloseAndStraightPointsGo) {
  std::vector<KindLine> square;
  const Vec2 corners[] = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (size_t i = 0; i < 5; ++i) square.push_back(edge(corners[i], corners[(i + 1) % 5]));
  const auto paths = chain_lines(square, 0.01);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_TRUE(paths[0].is_closed);
  EXPECT_EQ(paths[0].points.size(), 4u);
}

TEST(ChainLines, CurvesStayCurved) {
  std::vector<KindLine> circle;
  const auto at = [](int i) {
    return Vec2{std::cos(i * M_PI / 500), std::sin(i * M_PI / 500)} * 10;
  };
  for (int i = 0; i < 1000; ++i) circle.push_back(edge(at(i), at((i + 1) % 1000)));
  const auto paths = chain_lines(circle, 0.01);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_LT(paths[0].points.size(), 500u);
  std::vector<Vec2> points = paths[0].points;
  points.push_back(points.front());
  for (size_t i = 0; i + 1 < points.size(); ++i)
    EXPECT_NEAR(length((points[i] + points[i + 1]) * 0.5), 10, 0.02);
}

}  // namespace
}  // namespace whittle

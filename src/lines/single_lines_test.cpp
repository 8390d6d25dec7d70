#include "lines/single_lines.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

const Workers kWorkers(2);

double total(const std::vector<KindLine>& lines) {
  double sum = 0;
  for (const KindLine& line : lines) sum += length(line.segment.b - line.segment.a);
  return sum;
}

TEST(SingleLines, FirstStaysAndOthersLoseWhatLiesOnIt) {
  const std::vector<KindLine> lines = {{{{2, 0}, {5, 0}}, LineKind::kSilhouette},
                                       {{{0, 0.001}, {10, 0.001}}, LineKind::kEdge},
                                       {{{9, 0}, {4, 0}}, LineKind::kHidden}};
  const auto result = single_lines(lines, 0.01, 1e-3, kWorkers);
  ASSERT_TRUE(result);
  const std::vector<KindLine>& left = *result;
  ASSERT_EQ(left.size(), 3u);
  EXPECT_TRUE(left[0].segment.b == (Vec2{5, 0}));
  EXPECT_NEAR(left[1].segment.b.x, 2, 1e-9);
  EXPECT_NEAR(left[2].segment.a.x, 5, 1e-9);
  EXPECT_NEAR(total(left), 10, 1e-9);
}

TEST(SingleLines, LinesThatOnlyCrossOrGoOnStay) {
  const std::vector<KindLine> lines = {{{{0, 0}, {1, 0}}, LineKind::kEdge},
                                       {{{1, 0}, {2, 0.1}}, LineKind::kEdge},
                                       {{{0.5, -1}, {0.5, 1}}, LineKind::kEdge},
                                       {{{0, 0.02}, {1, 0.02}}, LineKind::kEdge},
                                       {{{0, 0}, {1, 0.2}}, LineKind::kEdge}};
  const auto left = single_lines(lines, 0.01, 1e-3, kWorkers);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->size(), lines.size());
}

TEST(SingleLines, PassNoLimit) {
  const std::vector<KindLine> pile(1000, {{{0, 0}, {1, 0}}, LineKind::kEdge});
  const auto left = single_lines(pile, 0.01, 1e-3, kWorkers);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->size(), 1u);
  const auto close = single_lines(pile, 0.01, 1e-3, kWorkers, {.pairs = 500'000});
  ASSERT_FALSE(close);
  EXPECT_EQ(close.error().kind, ErrorKind::kMachine);
  EXPECT_EQ(close.error().message, "too many lines of the drawing run close to one another");
  std::vector<KindLine> apart;
  for (int i = 0; i < 1000; ++i) apart.push_back({{{0, i + 0.0}, {1, i + 0.0}}, LineKind::kEdge});
  EXPECT_TRUE(single_lines(apart, 0.01, 1e-3, kWorkers, {.parts = 1000}));
  EXPECT_FALSE(single_lines(apart, 0.01, 1e-3, kWorkers, {.parts = 999}));
}

}  // namespace
}  // namespace whittle

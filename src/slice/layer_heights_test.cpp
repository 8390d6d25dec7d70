#include "slice/layer_heights.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace whittle {
namespace {

using Heights = std::vector<double>;

Heights parsed(std::string_view text) {
  const Result<Heights> heights = parse_heights(text);
  if (!heights) ADD_FAILURE() << text << ": " << heights.error().message;
  return heights ? *heights : Heights{};
}

std::string refusal(std::string_view text) {
  const Result<Heights> heights = parse_heights(text);
  if (heights) return "";
  EXPECT_EQ(heights.error().kind, ErrorKind::kUsage);
  return heights.error().message;
}

TEST(LayerHeights, AreNumbersAndRangesInTheirOrder) {
  EXPECT_EQ(parsed("2.5"), (Heights{2.5}));
  EXPECT_EQ(parsed("3,-1, 2e1"), (Heights{3, -1, 20}));
  EXPECT_EQ(parsed("0:3"), (Heights{0, 1, 2, 3}));
  EXPECT_EQ(parsed("1:0.5:2.2,7"), (Heights{1, 1.5, 2, 7}));
  EXPECT_EQ(parsed("2:-1:0"), (Heights{2, 1, 0}));
  EXPECT_EQ(parsed("4:2:4"), (Heights{4}));
}

TEST(LayerHeights, OfARangeAreTheDecimalsThatTheyLookLike) {
  const Heights heights = parsed("-1:0.1:40");
  ASSERT_EQ(heights.size(), 411u);
  for (size_t i = 0; i < heights.size(); ++i) {
    const int tenths = int(i) - 10;
    const std::string text = (tenths < 0 ? "-" : "") + std::to_string(std::abs(tenths) / 10) + "." +
                             std::to_string(std::abs(tenths) % 10);
    EXPECT_EQ(heights[i], std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(LayerHeights, ReachTheEndThatRoundingMisses) {
  EXPECT_EQ(parsed("0:0.1:0.3"), (Heights{0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(parsed("0:0.2:40").size(), 201u);
  // What is no decimal of a few digits takes steps as it is.
  const Heights thirds = parsed("0:0.33333333333333331:1");
  ASSERT_EQ(thirds.size(), 4u);
  EXPECT_EQ(thirds[3], 1.0);
}

TEST(LayerHeights, RefusesWhatIsNoList) {
  EXPECT_EQ(refusal(""), "'' is not a number");
  EXPECT_EQ(refusal("1,,2"), "'' is not a number");
  EXPECT_EQ(refusal("1:x:2"), "'x' is not a number");
  EXPECT_EQ(refusal("inf"), "'inf' is not a number");
  EXPECT_EQ(refusal("nan:1:2"), "'nan' is not a number");
  EXPECT_EQ(refusal("1:2:3:4"), "wants numbers and start:step:end, not 1:2:3:4");
  EXPECT_EQ(refusal("1:0:2"), "the range 1:0:2 has a step of 0");
  EXPECT_EQ(refusal("2:1"), "the range 2:1 has no values");
  EXPECT_EQ(refusal("0:-1:2"), "the range 0:-1:2 has no values");
}

TEST(LayerHeights, AreBounded) {
  EXPECT_EQ(parsed("1:100000").size(), kMostLayers);
  EXPECT_EQ(refusal("0:100000"), "wants at most 100000 layers, not 0:100000");
  EXPECT_EQ(refusal("1:100000,5"), "wants at most 100000 layers, not 1:100000,5");
  EXPECT_EQ(refusal("0:1e-300:1e300"), "wants at most 100000 layers, not 0:1e-300:1e300");
  EXPECT_EQ(refusal("-1.7e308:1:1.7e308"), "wants at most 100000 layers, not -1.7e308:1:1.7e308");
}

}  // namespace
}  // namespace whittle

#include "lines/segment_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace whittle {
namespace {

bool cross_one_another(const Segment& a, const Segment& b) {
  const auto side = [](const Segment& s, Vec2 p) { return cross(s.b - s.a, p - s.a); };
  return side(a, b.a) * side(a, b.b) <= 0 && side(b, a.a) * side(b, a.b) <= 0;
}

void expect_all_found(const std::vector<Segment>& segments, const std::vector<Segment>& asked) {
  const SegmentGrid grid(segments);
  SegmentGrid::Visited visited(segments.size());
  for (const Segment& one : asked) {
    std::vector<bool> found(segments.size(), false);
    size_t visits = 0;
    const size_t pairs = grid.for_near(one, visited, [&](uint32_t i) {
      EXPECT_FALSE(found[i]) << "named twice";
      found[i] = true;
      ++visits;
    });
    EXPECT_GE(pairs, visits);
    for (size_t i = 0; i < segments.size(); ++i)
      if (cross_one_another(one, segments[i])) {
        EXPECT_TRUE(found[i]);
      }
  }
}

TEST(SegmentGrid, FindsAllThatCross) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-10, 30), by(-1, 1);
  for (const double longest : {0.5, 3.0, 40.0}) {
    std::vector<Segment> segments;
    for (int i = 0; i < 300; ++i) {
      const Vec2 a{at(random), at(random)};
      segments.push_back({a, a + Vec2{by(random), by(random)} * longest});
    }
    expect_all_found(segments, segments);
  }
}

TEST(SegmentGrid, TakesLinesSquareToTheAxesAndOutside) {
  std::vector<Segment> segments;
  for (int i = 0; i < 40; ++i) {
    segments.push_back({{double(i), 0}, {double(i), 40}});
    segments.push_back({{0, double(i)}, {40, double(i)}});
  }
  std::vector<Segment> asked = segments;
  asked.push_back({{-100, -90}, {200, 140}});
  asked.push_back({{20, 300}, {20, -300}});
  expect_all_found(segments, asked);
  // All on one line, one alone, none.
  expect_all_found({segments[1], segments[1]}, asked);
  expect_all_found({segments[0]}, asked);
  expect_all_found({}, asked);
  expect_all_found({{{1, 1}, {1, 1}}}, asked);
}

}  // namespace
}  // namespace whittle

#include "flat/polygons.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "base/degrees.h"
#include "flat/polygons_for_test.h"

namespace whittle {
namespace {

bool has_corner(const Polygons& polygons, Vec2 corner) {
  for (const Contour& contour : polygons.contours)
    if (std::find(contour.begin(), contour.end(), corner) != contour.end()) return true;
  return false;
}

double united_area(std::vector<Polygons> operands) {
  return area(unite(operands));
}

Polygons random_region() {
  const bool coarse = *rc::gen::arbitrary<bool>();
  return even_odd(*rc::gen::container<std::vector<Contour>>(
      size_t(*rc::gen::inRange(1, 4)),
      coarse ? random_contour(12, 4, 1) : random_contour(12, 1000000, 4e-6)));
}

/// Signed areas: outer contours count, holes count off. Clipper drops what is thinner than a step.
void expect_equal_areas(double a, double b) {
  RC_ASSERT(std::abs(a - b) < 1e-7);
}

TEST(Polygons, CrossedPathsAreFilledEvenOdd) {
  // A five-pointed star: its middle is enclosed twice.
  Contour star;
  for (int i = 0; i < 5; ++i) star.push_back({cos_degrees(144.0 * i), sin_degrees(144.0 * i)});
  const Polygons filled_star = even_odd(std::array{star});
  // Each point is a triangle over a side of the inner pentagon.
  const double inner = std::pow(2 * std::cos(std::numbers::pi / 5), -2);
  const double side = 2 * inner * std::sin(std::numbers::pi / 5);
  const double height = 1 - inner * std::cos(std::numbers::pi / 5);
  EXPECT_NEAR(area(filled_star), 5 * side * height / 2, 1e-8);
  // An island within a hole.
  const std::vector<Contour> nested = {box(0, 0, 9, 9).contours[0], box(1, 1, 8, 8).contours[0],
                                       box(2, 2, 3, 3).contours[0]};
  EXPECT_DOUBLE_EQ(area(even_odd(nested)), 81 - 49 + 1);
}

TEST(Polygons, NonzeroCountsTurns) {
  // A star's middle is wound about twice; a hole is where the turns cancel.
  Contour star;
  for (int i = 0; i < 5; ++i) star.push_back({cos_degrees(144.0 * i), sin_degrees(144.0 * i)});
  EXPECT_GT(area(nonzero(std::array{star})), area(even_odd(std::array{star})) + 0.1);
  const Contour square = box(0, 0, 9, 9).contours[0], inner = box(1, 1, 8, 8).contours[0];
  EXPECT_DOUBLE_EQ(area(nonzero(std::array{square, inner})), 81);
  const Contour hole(inner.rbegin(), inner.rend());
  EXPECT_DOUBLE_EQ(area(nonzero(std::array{square, hole})), 81 - 49);
  EXPECT_TRUE(nonzero(std::vector<Contour>{}).is_empty());
}

TEST(Polygons, WrittenCornersComeBackToTheLastDigit) {
  const Vec2 odd[] = {{0.1, 0.2}, {1.0 / 3, 0.7}, {-0.12345678901234567, 5.0 / 7}};
  const Contour triangle(std::begin(odd), std::end(odd));
  const std::vector operands = {Polygons{{triangle}}, box(10, 10, 1000.1, 1000.3)};
  for (const Polygons& result :
       {even_odd(std::array{triangle}), unite(operands), subtract(operands)})
    for (const Vec2 corner : odd) EXPECT_TRUE(has_corner(result, corner));
  EXPECT_TRUE(has_corner(unite(operands), {1000.1, 1000.3}));
}

TEST(Polygons, AbuttingShapesAreOne) {
  const Polygons joined =
      unite(std::vector{box(0, 0, 0.1, 1), box(0.1, 0, 0.3, 1), box(0.3, 0, 1, 1)});
  ASSERT_EQ(joined.contours.size(), 1u);
  EXPECT_EQ(joined.contours[0].size(), 4u);
  EXPECT_DOUBLE_EQ(area(joined), 1);
}

TEST(Polygons, DifferenceOfEqualShapesIsEmpty) {
  const Polygons disc{{circle(1.234, 77)}};
  EXPECT_TRUE(subtract(std::vector{disc, disc}).is_empty());
  EXPECT_DOUBLE_EQ(area(intersect(std::vector{disc, disc})), area(disc));
}

TEST(Polygons, EmptyOperandsCount) {
  const Polygons square = box(0, 0, 1, 1);
  EXPECT_TRUE(subtract(std::vector{Polygons{}, square}).is_empty());
  EXPECT_TRUE(intersect(std::vector{square, Polygons{}}).is_empty());
  EXPECT_DOUBLE_EQ(united_area({square, Polygons{}}), 1);
  EXPECT_TRUE(minkowski_sum(std::vector{square, Polygons{}}).is_empty());
  for (const auto& nothing : {unite({}), intersect({}), subtract({}), minkowski_sum({}),
                              convex_hull({}), filled({}), offset({}, 1, Join::kRound, 8)})
    EXPECT_TRUE(nothing.is_empty());
}

TEST(Polygons, MirroredOperandsAreWhatTheyShow) {
  Polygons mirrored = box(0, 0, 2, 2);
  std::reverse(mirrored.contours[0].begin(), mirrored.contours[0].end());
  EXPECT_DOUBLE_EQ(united_area({mirrored, box(1, 1, 3, 3)}), 7);
}

TEST(Polygons, OffsetsOfASquare) {
  const Polygons square = box(0, 0, 10, 10);
  EXPECT_NEAR(area(offset(square, 1, Join::kMiter, 8)), 144, 1e-7);
  EXPECT_NEAR(area(offset(square, -1, Join::kMiter, 8)), 64, 1e-7);
  // Corners are cut at the distance.
  const double cut = 1 - std::numbers::sqrt2 / 2;
  EXPECT_NEAR(area(offset(square, 1, Join::kSquare, 8)), 144 - 4 * 2 * cut * cut, 1e-7);
  EXPECT_NEAR(area(offset(square, 1, Join::kRound, 2000)), 140 + std::numbers::pi, 1e-4);
  EXPECT_TRUE(offset(square, -5, Join::kRound, 8).is_empty());
  const Polygons same = offset(square, 0, Join::kRound, 8);
  EXPECT_EQ(area(same), 100);
  for (const Vec2 corner : square.contours[0]) EXPECT_TRUE(has_corner(same, corner));
  // Sharp corners stay sharp.
  const Polygons needle{{{{0, 0}, {1000, -1}, {1000, 1}}}};
  EXPECT_LT(bounds(offset(needle, 1, Join::kMiter, 8)).lo.x, -999);
}

TEST(Polygons, AsManyFragmentsAsAskedFor) {
  // A quarter turn at each corner of a square.
  EXPECT_EQ(offset(box(0, 0, 10, 10), 1, Join::kRound, 32).contours[0].size(), 4 * 9u);
  // Billions are not.
  EXPECT_LT(offset(box(0, 0, 10, 10), 1, Join::kRound, std::numeric_limits<int>::max())
                .contours[0]
                .size(),
            10000u);
}

TEST(Polygons, FilledHasNoHoles) {
  const std::vector<Contour> nested = {box(0, 0, 9, 9).contours[0], box(1, 1, 8, 8).contours[0],
                                       box(2, 2, 3, 3).contours[0]};
  const Polygons region = filled(even_odd(nested));
  EXPECT_EQ(region.contours.size(), 1u);
  EXPECT_DOUBLE_EQ(area(region), 81);
}

TEST(Polygons, HullHasNoCornersOnItsSides) {
  const Polygons hull = convex_hull(std::vector{box(0, 0, 1, 1), box(1, 0, 2, 1), box(0, 1, 1, 3)});
  ASSERT_EQ(hull.contours.size(), 1u);
  EXPECT_EQ(hull.contours[0].size(), 5u);
  EXPECT_DOUBLE_EQ(area(hull), 2 + 3);
  EXPECT_TRUE(convex_hull(std::vector{Polygons{{{{0, 0}, {1, 1}, {3, 3}}}}}).is_empty());
}

TEST(Polygons, MinkowskiSumsOfConvexShapes) {
  const Polygons sum = minkowski_sum(std::vector{box(0, 0, 0.1, 0.3), box(0.7, 0.1, 0.9, 0.2)});
  ASSERT_EQ(sum.contours.size(), 1u);
  EXPECT_EQ(sum.contours[0].size(), 4u);
  EXPECT_TRUE(has_corner(sum, {0.1 + 0.9, 0.3 + 0.2}));
  // Steiner's formula, with the disc as a polygon.
  const Polygons disc{{circle(1, 64)}};
  EXPECT_NEAR(area(minkowski_sum(std::vector{box(0, 0, 3, 2), disc})), 6 + 10 + area(disc), 1e-9);
}

TEST(Polygons, MinkowskiSumsKeepHolesThatAreLargeEnough) {
  Polygons frame = box(0, 0, 10, 10);
  frame.contours.push_back({{2, 2}, {2, 8}, {8, 8}, {8, 2}});
  EXPECT_DOUBLE_EQ(area(minkowski_sum(std::vector{frame, box(0, 0, 1, 1)})), 121 - 25);
  EXPECT_DOUBLE_EQ(area(minkowski_sum(std::vector{frame, box(0, 0, 7, 1)})), 17 * 11);
  // A frame within a frame: the hole shrinks by what the inner one is wide.
  Polygons small = box(0, 0, 2, 2);
  small.contours.push_back({{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}});
  EXPECT_DOUBLE_EQ(area(minkowski_sum(std::vector{frame, small})), 144 - 16);
  // Two pieces make two.
  const Polygons two = unite(std::vector{box(0, 0, 1, 1), box(100, 0, 101, 1)});
  EXPECT_DOUBLE_EQ(area(minkowski_sum(std::vector{frame, two})), 2 * (121 - 25));
}

TEST(Polygons, CircleIsExactOnTheAxes) {
  const Contour corners = circle(2, 4);
  EXPECT_EQ(corners, (Contour{{2, 0}, {0, 2}, {-2, 0}, {0, -2}}));
}

TEST(Polygons, BadNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Contour contour = {{0, 0}, {nan, 1}, {1, 0}, {1, 1}, {infinity, -infinity}, {0, 1}};
  EXPECT_DOUBLE_EQ(area(even_odd(std::array{contour})), 1);
  EXPECT_TRUE(offset(box(0, 0, 1, 1), nan, Join::kRound, 8).is_empty());
  EXPECT_TRUE(even_odd(std::array{Contour{{nan, nan}, {nan, 0}, {0, nan}}}).is_empty());
}

TEST(Polygons, SizeDoesNotMatter) {
  for (const double size : {1e-300, 1e-20, 1e20, 1e150}) {
    const Polygons joined = unite(std::vector{box(0, 0, size, size), box(size, 0, 2 * size, size)});
    ASSERT_EQ(joined.contours.size(), 1u);
    EXPECT_EQ(bounds(joined).hi.x, 2 * size);
  }
}

TEST(Polygons, ManyEdgesAreFast) {
  const Polygons wheel{{circle(100, 10000)}}, hole{{circle(50, 10000)}};
  const Polygons ring = subtract(std::vector{wheel, hole});
  EXPECT_EQ(ring.contours.size(), 2u);
  EXPECT_NEAR(area(ring), area(wheel) - area(hole), 1e-6);
}

RC_GTEST_PROP(PolygonsProperty, AreasAddUp, ()) {
  const Polygons a = random_region(), b = random_region();
  const std::vector both = {a, b}, other = {b, a};
  const double common = area(intersect(both));
  expect_equal_areas(area(unite(both)) + common, area(a) + area(b));
  expect_equal_areas(area(subtract(both)) + common, area(a));
  expect_equal_areas(area(subtract(other)) + common, area(b));
}

RC_GTEST_PROP(PolygonsProperty, EvenOddCountsCrossings, ()) {
  const bool coarse = *rc::gen::arbitrary<bool>();
  const auto contours = *rc::gen::container<std::vector<Contour>>(
      size_t(*rc::gen::inRange(1, 4)),
      coarse ? random_contour(12, 4, 1) : random_contour(12, 400, 0.01));
  const auto crossings = [](const std::vector<Contour>& all, Vec2 p) {
    int count = 0;
    for (const Contour& contour : all) {
      for (size_t i = 0; i < contour.size(); ++i) {
        const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
          ++count;
      }
    }
    return count % 2;
  };
  const Polygons region = even_odd(contours);
  for (int i = 0; i < 20; ++i) {
    // Beside the grid, so that points are on no edge.
    const Vec2 p = {*rc::gen::inRange(-400, 400) * 0.01 + 0.0031415,
                    *rc::gen::inRange(-400, 400) * 0.01 + 0.0027182};
    RC_ASSERT(crossings(contours, p) == crossings(region.contours, p));
  }
}

RC_GTEST_PROP(PolygonsProperty, ResultsAreStable, ()) {
  const Polygons a = random_region();
  RC_ASSERT(std::abs(area(even_odd(a.contours)) - area(a)) < 1e-8);
  RC_ASSERT(area(a) >= 0);
}

RC_GTEST_PROP(PolygonsProperty, OffsetsAreNested, ()) {
  const Polygons a = random_region();
  const double delta = *rc::gen::element(0.001, 0.1, 1.0);
  const Join join = *rc::gen::element(Join::kRound, Join::kMiter, Join::kSquare);
  const Polygons larger = offset(a, delta, join, 16), smaller = offset(a, -delta, join, 16);
  RC_ASSERT(area(subtract(std::vector{a, larger})) < 1e-7);
  RC_ASSERT(area(subtract(std::vector{smaller, a})) < 1e-7);
}

RC_GTEST_PROP(PolygonsProperty, MinkowskiSumsAreTheSameBothWays, ()) {
  const Polygons a = random_region();
  const Polygons b = even_odd(std::array{*random_contour(5, 3, 0.25)});
  const Polygons ab = minkowski_sum(std::vector{a, b}), ba = minkowski_sum(std::vector{b, a});
  RC_ASSERT(area(subtract(std::vector{ab, ba})) < 1e-6);
  RC_ASSERT(area(subtract(std::vector{ba, ab})) < 1e-6);
  // Sums of corners are in it.
  const Polygons hull = convex_hull(std::vector{ab});
  RC_ASSERT(area(hull) + 1e-6 >= area(ab));
}

}  // namespace
}  // namespace whittle

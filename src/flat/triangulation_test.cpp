#include "flat/triangulation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <map>
#include <numbers>

#include "flat/orientation.h"
#include "flat/polygons_for_test.h"

namespace whittle {
namespace {

using Edges = std::map<std::pair<uint32_t, uint32_t>, int>;

void count_edge(Edges& edges, uint32_t a, uint32_t b) {
  if (a < b)
    ++edges[{a, b}];
  else
    --edges[{b, a}];
}

/// What is left of the triangles' edges once the contours' are taken off must be nothing.
bool has_same_outline(const WeldedPolygons& polygons,
                      const std::vector<std::array<uint32_t, 3>>& triangles) {
  Edges edges;
  for (const auto& contour : polygons.contours)
    for (size_t i = 0; i < contour.size(); ++i)
      count_edge(edges, contour[(i + 1) % contour.size()], contour[i]);
  for (const auto& t : triangles)
    for (size_t k = 0; k < 3; ++k) count_edge(edges, t[k], t[(k + 1) % 3]);
  for (const auto& [edge, count] : edges)
    if (count != 0) return false;
  return true;
}

double total_area(const Polygons& polygons, bool absolute) {
  double total = 0;
  for (const auto& [a, b, c] : triangulate(polygons)) {
    const double twice = cross(b - a, c - a);
    total += absolute ? std::abs(twice) : twice;
  }
  return total / 2;
}

void expect_filled(const Polygons& polygons) {
  const WeldedPolygons welded = weld(polygons);
  const auto triangles = triangulate(welded);
  EXPECT_TRUE(has_same_outline(welded, triangles));
  const double expected = area(polygons);
  EXPECT_NEAR(total_area(polygons, false), expected, 1e-9 * std::abs(expected));
  EXPECT_NEAR(total_area(polygons, true), expected, 1e-9 * std::abs(expected));
}

TEST(Triangulation, SquareIsTwoTriangles) {
  EXPECT_EQ(triangulate(box(0, 0, 1, 1)).size(), 2u);
  expect_filled(box(0, 0, 1, 1));
}

TEST(Triangulation, HolesStayEmpty) {
  Polygons frame = box(0, 0, 10, 10);
  for (double x = 1; x < 9; x += 2)
    for (double y = 1; y < 9; y += 2)
      frame.contours.push_back({{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}});
  expect_filled(frame);
}

TEST(Triangulation, CornersMayTouch) {
  Polygons chess;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      if ((x + y) % 2 == 0) chess.contours.push_back(box(x, y, x + 1, y + 1).contours[0]);
  expect_filled(chess);
  // A diamond that touches the frame around it in all four corners.
  expect_filled({{{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 4}, {0, 2}},
                  {{2, 0}, {0, 2}, {2, 4}, {4, 2}}}});
  // The same as one contour that comes twice through two corners.
  expect_filled({{{{0, 0}, {2, 0}, {0, 2}}, {{2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {4, 2}}}});
}

TEST(Triangulation, CornersInStraightRunsStay) {
  Contour contour;
  for (int i = 0; i < 10; ++i) contour.push_back({double(i), 0});
  for (int i = 0; i < 10; ++i) contour.push_back({10, double(i)});
  for (int i = 0; i < 10; ++i) contour.push_back({10.0 - i, 10});
  for (int i = 0; i < 10; ++i) contour.push_back({0, 10.0 - i});
  expect_filled({{contour}});
  for (const auto& [a, b, c] : triangulate(Polygons{{contour}})) EXPECT_GT(orientation(a, b, c), 0);
}

TEST(Triangulation, CornerWithinAnEdgeIsTolerated) {
  // The diamond's corners lie in the middle of the frame's edges.
  expect_filled({{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{2, 0}, {0, 2}, {2, 4}, {4, 2}}}});
}

TEST(Triangulation, NothingIsMadeOfNothing) {
  EXPECT_TRUE(triangulate(Polygons{}).empty());
  EXPECT_TRUE(triangulate(Polygons{{{}}}).empty());
  EXPECT_TRUE(triangulate(Polygons{{{{1, 1}}}}).empty());
  EXPECT_TRUE(triangulate(Polygons{{{{1, 1}, {2, 2}}}}).empty());
  EXPECT_TRUE(triangulate(Polygons{{{{1, 1}, {1, 1}, {1, 1}}}}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(triangulate(Polygons{{{{1, nan}, {nan, 2}, {1, 1}}}}).empty());
}

TEST(Triangulation, CornersThatAreNotFiniteAreLeftOut) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Polygons polygons{{{{0, 0}, {1, 0}, {infinity, 3}, {1, 1}, {0, 1}}}};
  EXPECT_DOUBLE_EQ(total_area(polygons, false), 1);
}

TEST(Triangulation, SizeDoesNotMatter) {
  for (const double size : {1e-300, 1e-150, 1e150, 1e300}) {
    const WeldedPolygons welded = weld(box(0, 0, size, size));
    const auto triangles = triangulate(welded);
    EXPECT_EQ(triangles.size(), 2u);
    EXPECT_TRUE(has_same_outline(welded, triangles));
  }
}

TEST(Triangulation, ManyEdgesAreFast) {
  // A comb, a wheel with many teeth and a spiral, each of tens of thousands of edges.
  const int n = 20000;
  Contour comb, wheel;
  for (int i = 0; i < n; ++i) {
    comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1000.0});
    const double angle = 2 * std::numbers::pi * i / n, r = i % 2 == 0 ? 1.0 : 2.0;
    wheel.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  comb.push_back({double(n), -1});
  comb.push_back({-1, -1});
  expect_filled({{wheel}});
  std::reverse(comb.begin(), comb.end());
  EXPECT_NEAR(std::abs(total_area({{comb}}, true)), std::abs(area(comb)), 1e-3);
  Contour spiral;
  for (int i = 0; i < n; ++i)
    spiral.push_back({(1.0 + i) * std::cos(i * 0.1), (1.0 + i) * std::sin(i * 0.1)});
  for (int i = n; i-- > 0;)
    spiral.push_back({(9.0 + i) * std::cos(i * 0.1), (9.0 + i) * std::sin(i * 0.1)});
  if (area(spiral) < 0) std::reverse(spiral.begin(), spiral.end());
  expect_filled({{spiral}});
}

RC_GTEST_PROP(TriangulationProperty, RegionsAreFilledWithoutOverlap, ()) {
  const auto contours = *rc::gen::container<std::vector<Contour>>(
      size_t(*rc::gen::inRange(1, 5)), random_contour(12, 1000000, 1e-4));
  const Polygons polygons = even_odd(contours);
  const WeldedPolygons welded = weld(polygons);
  RC_ASSERT(has_same_outline(welded, triangulate(welded)));
  const double expected = area(polygons), tolerance = 1e-7 * (expected + 1);
  RC_ASSERT(std::abs(total_area(polygons, false) - expected) < tolerance);
  RC_ASSERT(std::abs(total_area(polygons, true) - expected) < tolerance);
}

RC_GTEST_PROP(TriangulationProperty, CornersOnAGridTouch, ()) {
  const auto contours = *rc::gen::container<std::vector<Contour>>(size_t(*rc::gen::inRange(1, 5)),
                                                                  random_contour(20, 4, 1));
  const Polygons polygons = even_odd(contours);
  const WeldedPolygons welded = weld(polygons);
  RC_ASSERT(has_same_outline(welded, triangulate(welded)));
  const double expected = area(polygons), tolerance = 1e-7 * (expected + 1);
  RC_ASSERT(std::abs(total_area(polygons, false) - expected) < tolerance);
  RC_ASSERT(std::abs(total_area(polygons, true) - expected) < tolerance);
}

RC_GTEST_PROP(TriangulationProperty, NoEdgeIsLostWhateverCrosses, ()) {
  const int extent = *rc::gen::element(3, 1000);
  const Polygons polygons{*rc::gen::container<std::vector<Contour>>(size_t(*rc::gen::inRange(1, 5)),
                                                                    random_contour(30, extent, 1))};
  const WeldedPolygons welded = weld(polygons);
  RC_ASSERT(has_same_outline(welded, triangulate(welded)));
  RC_ASSERT(std::abs(total_area(polygons, false) - area(polygons)) < 1e-6 * extent * extent);
}

}  // namespace
}  // namespace whittle

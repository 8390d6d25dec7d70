// Solids made in code are those that a text makes.
#include <gtest/gtest.h>

#include <cmath>

#include "whittle/whittle.h"

namespace {

using whittle::Csg;
using whittle::Point;
using whittle::Solid;

whittle::Rendering picture(const Solid& solid) {
  whittle::RenderOptions options{.width = 60, .height = 45};
  options.eye = {50, -60, 40};
  options.center = {2, 1, 0};
  return solid.render(options);
}

void expect_same(const Csg& made, const char* text, const whittle::LoadOptions& options = {}) {
  SCOPED_TRACE(text);
  const Solid code = Solid::make(made, options), read = Solid::parse(text, "text", options);
  const whittle::Rendering a = picture(code), b = picture(read);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.rgba, b.rgba);
  EXPECT_EQ(code.statement_count(), read.statement_count());
  EXPECT_TRUE(code.is_complete());
  EXPECT_TRUE(code.warnings().empty());
  std::size_t hits = 0;
  for (const std::uint32_t id : a.id) hits += id != 0;
  EXPECT_GT(hits, 20u) << "it is seen";
}

const Csg kCube = Csg::cube({10, 8, 6});

TEST(Csg, ShapesAreThoseOfTheFormat) {
  expect_same(kCube, "cube([10, 8, 6]);");
  expect_same(Csg::cube({10, 8, 6}, true), "cube([10, 8, 6], center = true);");
  expect_same(Csg::sphere(6), "sphere(6);");
  expect_same(Csg::sphere(6, 9), "sphere(6, $fn = 9);");
  expect_same(Csg::cylinder(9, 4), "cylinder(h = 9, r = 4);");
  expect_same(Csg::cone(9, 0, 5, true, 6),
              "cylinder(h = 9, r1 = 0, r2 = 5, center = true, $fn = 6);");
  expect_same(Csg::polyhedron({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}},
                              {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}),
              "polyhedron([[0,0,0],[9,0,0],[0,9,0],[0,0,9]], [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);");
  expect_same(kCube & Csg::half_space({1, 0, 1}, 7),
              "intersection() { cube([10, 8, 6]); halfspace(n = [1, 0, 1], d = 7); }");
  expect_same(Csg::extrusion({{0, 0}, {9, 0}, {3, 3}, {0, 9}}, 5),
              "linear_extrude(5) polygon([[0,0],[9,0],[3,3],[0,9]]);");
}

TEST(Csg, OperationsAreThoseOfTheFormat) {
  const Csg ball = Csg::sphere(5).moved({10, 4, 3});
  expect_same(kCube | ball, "cube([10, 8, 6]); translate([10, 4, 3]) sphere(5);");
  expect_same(kCube - ball, "difference() { cube([10, 8, 6]); translate([10, 4, 3]) sphere(5); }");
  expect_same(Csg::hull_of({kCube, Csg::cylinder(9, 2).moved({12, 0, 0})}),
              "hull() { cube([10, 8, 6]); translate([12, 0, 0]) cylinder(h = 9, r = 2); }");
  expect_same(kCube.turned({10, 20, 30}).scaled({1, 2, 1}),
              "scale([1, 2, 1]) rotate([10, 20, 30]) cube([10, 8, 6]);");
  expect_same(kCube.transformed({{{1, 0.5, 0, 3}, {0, 1, 0, 1}, {0, 0, 2, 0}}}),
              "multmatrix([[1, 0.5, 0, 3], [0, 1, 0, 1], [0, 0, 2, 0], [0, 0, 0, 1]]) "
              "cube([10, 8, 6]);");
  expect_same(kCube.colored(1, 0.5f, 0), "color([1, 0.5, 0, 1]) cube([10, 8, 6]);");
}

TEST(Csg, AStyleBringsItsFacetsAlong) {
  expect_same(Csg::sphere(6) | Csg::cylinder(9, 4), "sphere(6); cylinder(h = 9, r = 4);",
              {.style = whittle::Style::kOpenscad});
  expect_same(Csg::sphere(6, 9), "sphere(6, $fn = 9);", {.curves = whittle::Curves::kSmooth});
}

TEST(Csg, PartsCanBeShared) {
  const Csg hole = Csg::cylinder(20, 1, true);
  Csg plate = Csg::cube({20, 10, 2});
  for (int i = 1; i < 5; ++i) plate = plate - hole.moved({4.0 * i, 5, 0});
  EXPECT_EQ(Solid::make(plate).statement_count(), 5u);
}

TEST(Csg, DepthCostsNoStack) {
  Csg chain = kCube;
  for (int i = 0; i < 300'000; ++i) chain = chain | kCube;
  EXPECT_EQ(Solid::make(chain).statement_count(), 300'001u);
}

TEST(Csg, RefusesWhatNoTextCouldSay) {
  using whittle::Failure;
  EXPECT_THROW((void)Csg::cube({NAN, 1, 1}), Failure);
  EXPECT_THROW((void)Csg::sphere(INFINITY), Failure);
  EXPECT_THROW((void)Csg::sphere(1, 2), Failure);
  EXPECT_THROW((void)Csg::cylinder(1, 1, false, -1), Failure);
  EXPECT_THROW((void)kCube.colored(2, 0, 0), Failure);
  EXPECT_THROW((void)kCube.moved({0, NAN, 0}), Failure);
  EXPECT_THROW((void)Csg::polyhedron({{0, 0, 0}}, {{0, 1, 2}}), Failure);
}

TEST(Csg, RefusesWhatPassesALimit) {
  Csg many = kCube;
  for (int i = 0; i < 40; ++i) many = many | many;
  whittle::LoadOptions options;
  options.limits.nodes = 10'000;
  EXPECT_THROW((void)Solid::make(many, options), whittle::Failure);
}

}  // namespace

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "evaluate/evaluate_test_support.h"
#include "evaluate/revolution.h"

namespace whittle {
namespace {

ReadOptions facetted() {
  ReadOptions options;
  options.curves = Curves::kFacets;
  return options;
}

TEST(RotateExtrude, ASquareIsAPipe) {
  expect_same("rotate_extrude() translate([2, 1]) square(3);",
              "difference() { translate([0, 0, 1]) cylinder(h = 3, r = 5); cylinder(h = 9, r = 2); "
              "}");
  expect_same("rotate_extrude() square(3);", "cylinder(h = 3, r = 3);");
  expect_same("rotate_extrude() translate([-5, 1]) square(3);",
              "rotate_extrude() translate([2, 1]) square(3);");
}

TEST(RotateExtrude, IsOneBodyOfItsOwnId) {
  const Model model =
      evaluated("cube(); rotate_extrude() translate([2, 1]) square(3); cube();").model;
  ASSERT_EQ(model.primitives.size(), 4u);
  EXPECT_EQ(model.primitives[1].id, 2u);
  EXPECT_EQ(model.primitives[2].id, 2u);
  EXPECT_EQ(model.primitives[3].id, 4u);
  EXPECT_EQ(lone_primitive(evaluated("rotate_extrude() translate([2, 1]) square(3);").model), 1u);
  // What is cut out inside of a body is none of its cut faces.
  EXPECT_FALSE(appearances(model)[2].cut);
}

TEST(RotateExtrude, SlantedSidesAreCones) {
  expect_same("rotate_extrude() polygon([[0, 0], [3, 0], [0, 6]]);",
              "cylinder(h = 6, r1 = 3, r2 = 0);");
  expect_same(
      "rotate_extrude() polygon([[0, 0], [3, 0], [5, 2], [1, 4], [0, 4]]);",
      "cylinder(h = 2, r1 = 3, r2 = 5); translate([0, 0, 2]) cylinder(h = 2, r1 = 5, r2 = 1);");
  expect_same("rotate_extrude() polygon([[2, 0], [6, 2], [2, 4]]);",
              "difference() { union() { cylinder(h = 2, r1 = 2, r2 = 6); translate([0, 0, 2]) "
              "cylinder(h = 2, r1 = 6, r2 = 2); } translate([0, 0, -1]) cylinder(h = 9, r = 2); }");
  // Concave, with a hole.
  expect_same(
      "rotate_extrude() difference() { square(9); translate([2, 2]) square(3); translate([5, "
      "4]) square(9); }",
      "difference() { cylinder(h = 9, r = 9); difference() { translate([0, 0, 2]) cylinder(h "
      "= 3, r = 5); cylinder(h = 9, r = 2); } difference() { translate([0, 0, 4]) "
      "cylinder(h = 9, r = 10); cylinder(h = 20, r = 5); } }");
}

TEST(RotateExtrude, CornersAtOneHeightButForRoundingMakeNoFilm) {
  // The second step of the grid above 3, and 3.
  for (const double off : {4e-10, -4e-10}) {
    Budget budget(1000);
    const Polygons profile{{{{1, 0}, {4, 0}, {4, 3}, {2, 3 + off}, {2, 5}, {1, 5 + off}}}};
    const std::vector<Ring> found = rings(profile, budget);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].z + found[0].outer.h, found[1].z);
    EXPECT_NEAR(found[1].z, 3, 1e-9);
    EXPECT_NEAR(found[1].outer.h, 2, 1e-9);
  }
}

TEST(RotateExtrude, PartsOfATurn) {
  const std::string profile = "translate([2, 0]) square(3);";
  const std::string whole = "rotate_extrude() " + profile;
  const auto quarter = [](int k) {
    return "rotate(" + std::to_string(90 * k) + ") cube([9, 9, 9]);";
  };
  expect_same("rotate_extrude(angle = 90) " + profile,
              "intersection() { " + whole + quarter(0) + "}");
  expect_same("rotate_extrude(angle = -90) " + profile,
              "intersection() { " + whole + quarter(3) + "}");
  expect_same("rotate_extrude(angle = 180) " + profile,
              "intersection() { " + whole + "union() {" + quarter(0) + quarter(1) + "} }");
  expect_same("rotate_extrude(angle = 270) " + profile,
              "difference() { " + whole + quarter(3) + "}");
  expect_same("rotate_extrude(angle = 90, start = 90) " + profile,
              "intersection() { " + whole + quarter(1) + "}");
  expect_same("rotate_extrude(angle = 90) translate([-5, 0]) square(3);",
              "intersection() { " + whole + quarter(2) + "}");
  for (const char* angle : {"360", "400", "-360", "-500"}) {
    expect_same("rotate_extrude(angle = " + std::string(angle) + ") " + profile, whole);
  }
  expect_empty("rotate_extrude(angle = 0) " + profile);
}

TEST(RotateExtrude, FacetsAreOpenscads) {
  expect_same("rotate_extrude($fn = 6) square(3);", "rotate(180) cylinder(h = 3, r = 3, $fn = 6);");
  expect_same("rotate_extrude($fn = 5) square(3);", "rotate(180) cylinder(h = 3, r = 3, $fn = 5);");
  expect_same("rotate_extrude(angle = 360, start = 0, $fn = 5) square(3);",
              "cylinder(h = 3, r = 3, $fn = 5);");
  expect_same("rotate_extrude($fn = 5) translate([-3, 0]) square(3);",
              "cylinder(h = 3, r = 3, $fn = 5);");
  expect_same("rotate_extrude() square(3);", "rotate(180) cylinder(h = 3, r = 3);", facetted());
  // The number follows from the whole radius.
  expect_same("rotate_extrude($fa = 1, $fs = 2) translate([7, 0]) square(3);",
              "difference() { rotate(180) cylinder(h = 3, r = 10, $fn = 32); rotate(180) translate("
              "[0, 0, -1]) cylinder(h = 9, r = 7, $fn = 32); }",
              facetted());
}

TEST(RotateExtrude, AcrossTheAxisIsNothingAndSaid) {
  const Read read = evaluated("rotate_extrude() translate([-1, 0]) square(3);");
  EXPECT_TRUE(bounds(read.model).box.is_empty());
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(
      read.warnings[0],
      "t.csg:1:1: warning: what is revolved reaches across the axis, from x = -1 to 2; nothing "
      "is shown for it");
  EXPECT_TRUE(read.unsupported);
  expect_empty("rotate_extrude();");
  expect_empty("rotate_extrude() square(0);");
  expect_empty("rotate_extrude() cube(3);");
}

TEST(Rings, GoOnBetweenTheSameSides) {
  Budget budget(1000);
  // A corner on the far side cuts no other ring.
  const Polygons profile{
      {{{0, 0}, {1, 0}, {1, 9}, {0, 9}}, {{2, 0}, {3, 0}, {4, 5}, {3, 9}, {2, 9}}}};
  const std::vector<Ring> found = rings(profile, budget);
  ASSERT_EQ(found.size(), 3u);
  double tallest = 0;
  for (const Ring& ring : found) tallest = std::fmax(tallest, ring.outer.h);
  EXPECT_EQ(tallest, 9);
}

RC_GTEST_PROP(RotateExtrude, OfRandomPolygonsHoldsWhatThePolygonHolds, ()) {
  std::string points;
  const int n = *rc::gen::inRange(3, 9);
  for (int i = 0; i < n; ++i) {
    points += "[" + std::to_string(*rc::gen::inRange(0, 9)) + "," +
              std::to_string(*rc::gen::inRange(-5, 6)) + "],";
  }
  const std::string polygon = "polygon([" + points + "]);";
  const Model body = evaluated("rotate_extrude() " + polygon).model;
  const Model profile = evaluated("linear_extrude(2, center = true) " + polygon).model;
  const Inside in_body(body), in_profile(profile);
  Points spread({{-9, -9, -6}, {9, 9, 6}});
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = spread.next();
    RC_ASSERT(in_body(p) == in_profile({std::hypot(p.x, p.y), p.z, 0}));
  }
}

}  // namespace
}  // namespace whittle

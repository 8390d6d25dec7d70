#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "evaluate/evaluate_test_support.h"

namespace whittle {
namespace {

const Node& only_body(const Model& model) {
  const Node* body = nullptr;
  for (const Node& node : model.nodes) {
    if (node.kind == NodeKind::kBody) body = &node;
  }
  EXPECT_NE(body, nullptr);
  return *body;
}

TEST(LinearExtrude, ASquareIsACube) {
  expect_same("linear_extrude(height = 3) square([4, 5]);", "cube([4, 5, 3]);");
  expect_same("linear_extrude(height = 3, center = true) square([4, 5], center = true);",
              "cube([4, 5, 3], center = true);");
  expect_same("linear_extrude(height = 3) square(2, center = true);",
              "translate([-1, -1, 0]) cube([2, 2, 3]);");
  expect_same("linear_extrude() square();", "cube([1, 1, 100]);");
  const Model model = evaluated("linear_extrude(2) square(3);").model;
  ASSERT_EQ(model.primitives.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<Cube>(model.primitives[0].shape));
}

TEST(LinearExtrude, ACircleIsACylinder) {
  const Model smooth = evaluated("linear_extrude(height = 3) circle(5);").model;
  ASSERT_EQ(smooth.primitives.size(), 1u);
  const auto* const cylinder = std::get_if<Cylinder>(&smooth.primitives[0].shape);
  ASSERT_NE(cylinder, nullptr);
  EXPECT_EQ(cylinder->facets, 0);
  for (const char* fragments : {"$fn = 7", "$fn = 0, $fa = 30, $fs = 1", "$fn = 6.5"}) {
    for (const Curves curves :
         {Curves::kAuto, Curves::kFacets, Curves::kSmooth, Curves::kOpenscad2021}) {
      ReadOptions options;
      options.curves = curves;
      const std::string f = fragments;
      expect_same("linear_extrude(height = 3) circle(r = 5, " + f + ");",
                  "cylinder(h = 3, r = 5, " + f + ");", options);
    }
  }
}

TEST(LinearExtrude, ScopesOfFragmentsReachFlatShapes) {
  expect_same("linear_extrude(2, $fn = 5) circle(3);", "cylinder(h = 2, r = 3, $fn = 5);");
  expect_same("linear_extrude(2) circle(3); $fn = 6;", "cylinder(h = 2, r = 3, $fn = 6);");
  expect_same("$fn = 6; linear_extrude(2, $fn = 8) circle(3, $fn = 5);",
              "cylinder(h = 2, r = 3, $fn = 5);");
}

TEST(LinearExtrude, IsOneBodyOfItsOwnId) {
  const Model model =
      evaluated("cube(); linear_extrude(2) { circle(1); difference() { square(2); circle(1); } }")
          .model;
  const Node& body = only_body(model);
  EXPECT_EQ(body.payload, 2u);
  EXPECT_EQ(model.statement_count, 5u);
  ASSERT_EQ(model.primitives.size(), 4u);
  for (size_t i = 1; i < 4; ++i) EXPECT_EQ(model.primitives[i].id, 2u);
  EXPECT_EQ(lone_primitive(evaluated("linear_extrude(2) { circle(1); square(2); }").model), 1u);
}

TEST(LinearExtrude, HasOneLook) {
  const std::vector<Appearance> looks =
      appearances(evaluated("difference() { cube(9); color(\"red\") linear_extrude(2) "
                            "difference() { square(2); color(\"blue\") circle(1); } }")
                      .model);
  EXPECT_EQ(looks[2].color, (Rgba{1, 0, 0, 1}));
  EXPECT_TRUE(looks[2].cut);
}

TEST(LinearExtrude, CommutesWithBooleansAndMaps) {
  expect_same(
      "linear_extrude(2) difference() { square(10); translate([5, 5, 7]) rotate(30) square(4); "
      "intersection() { circle(3); square(2); } }",
      "difference() { cube([10, 10, 2]); translate([5, 5, -1]) rotate(30) cube([4, 4, 4]); "
      "translate([0, 0, -1]) intersection() { cylinder(r = 3, h = 4); cube([2, 2, 4]); } }");
  expect_same(
      "linear_extrude(2) multmatrix([[1, 0.5, 9, 3], [0.2, 2, 9, 4], [9, 9, 0, 9]]) "
      "square(3);",
      "multmatrix([[1, 0.5, 0, 3], [0.2, 2, 0, 4]]) cube([3, 3, 2]);");
  expect_same("linear_extrude(2) mirror([1, 0]) translate([1, 0]) square(3);",
              "translate([-4, 0, 0]) cube([3, 3, 2]);");
}

TEST(LinearExtrude, AFlatMapIsOnlyOneThatFlattensThePlane) {
  expect_same("linear_extrude(2) scale([1, 2, 0]) square(3);", "cube([3, 6, 2]);");
  const Read read = evaluated("linear_extrude(2) scale([1, 0, 1]) square(3);");
  EXPECT_TRUE(bounds(read.model).box.is_empty());
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(read.warnings[0],
            "t.csg:1:19: warning: this transform flattens space; what it moves is left empty");
}

TEST(LinearExtrude, TheVectorShears) {
  expect_same("linear_extrude(height = 5, v = [0, 0, 3]) square(2);", "cube([2, 2, 5]);");
  expect_same("linear_extrude(v = [0, 3, 4]) square(2);",
              "multmatrix([[1, 0, 0, 0], [0, 1, 0.75, 0], [0, 0, 1, 0]]) cube([2, 2, 4]);");
  expect_same("linear_extrude(10, v = [0, 3, 4], center = true) square(2);",
              "multmatrix([[1, 0, 0, 0], [0, 1, 0.75, -3], [0, 0, 1, -4]]) cube([2, 2, 8]);");
  expect_empty("linear_extrude(v = [0, 3, -4]) square(2);");
  expect_empty("linear_extrude(v = [1, 0, 0]) square(2);");
  EXPECT_EQ(evaluated("linear_extrude(5, v = [0, 0, 0]) square(2);").warnings.size(), 1u);
}

TEST(LinearExtrude, OfNothingOrNoHeightIsEmptyAndAnOperand) {
  for (const char* text :
       {"linear_extrude(3);", "linear_extrude(0) square();", "linear_extrude(-3) square();",
        "linear_extrude(3) square(0);", "linear_extrude(3) circle(-1);",
        "linear_extrude(inf) square();", "linear_extrude(3) polygon([[0, 0], [1, 1]]);",
        "linear_extrude(3) cube();", "difference() { linear_extrude(0) square(); cube(); }",
        "difference() { linear_extrude(3); cube(); }",
        "intersection() { cube(); linear_extrude(3) polygon(); }"}) {
    expect_empty(text);
  }
}

TEST(LinearExtrude, WithScaleOrTwistIsAsOpenscadCutsIt) {
  expect_same("linear_extrude(height = 4, scale = 0) square(2, center = true);",
              "polyhedron([[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0],[0,0,4]], "
              "[[0,1,2,3],[4,1,0],[4,2,1],[4,3,2],[4,0,3]]);");
  expect_same("linear_extrude(height = 4, scale = [2, 2]) square(2, center = true);",
              "polyhedron([[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0],[-2,-2,4],[2,-2,4],[2,2,4],"
              "[-2,2,4]], [[0,1,2,3],[4,5,1,0],[7,6,5,4],[5,6,2,1],[6,7,3,2],[7,4,0,3]]);");
  // Negative scales are 0.
  expect_same("linear_extrude(height = 4, scale = -1) square(2, center = true);",
              "linear_extrude(height = 4, scale = 0) square(2, center = true);");
  const Model twisted =
      evaluated("linear_extrude(height = 10, twist = 90, slices = 20) square([4, 1]);").model;
  ASSERT_EQ(twisted.primitives.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<Mesh>(twisted.primitives[0].shape));
  const Box box{{-5, -5, -1}, {5, 5, 11}};
  EXPECT_NEAR(filled_share(twisted, box) * 10 * 10 * 12, 40, 2);
  const Inside inside(twisted);
  EXPECT_TRUE(inside({3, 0.5, 0.1}));
  EXPECT_TRUE(inside({0.5, -3, 9.9})) << "clockwise";
}

TEST(LinearExtrude, SlicesAloneChangeNothing) {
  expect_same("linear_extrude(height = 3, slices = 7) square([4, 5]);", "cube([4, 5, 3]);");
}

TEST(Polygon, ConvexOnesArePrisms) {
  const Model model =
      evaluated("linear_extrude(2) polygon([[0, 0], [4, 0], [2, 3], [2, 3]]);").model;
  ASSERT_EQ(model.primitives.size(), 1u);
  const auto* const prism = std::get_if<Polyhedron>(&model.primitives[0].shape);
  ASSERT_NE(prism, nullptr);
  EXPECT_EQ(prism->planes.size(), 5u);
  expect_same("linear_extrude(2) polygon([[0, 0], [0, 3], [3, 3], [3, 0]]);", "cube([3, 3, 2]);");
}

TEST(Polygon, OthersAreMeshes) {
  expect_same("linear_extrude(2) polygon([[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]);",
              "difference() { cube([4, 4, 2]); translate([0, 0, -1]) linear_extrude(4) "
              "polygon([[0, 4], [2, 1], [4, 4]]); }");
  // Evenly often enclosed is outside.
  expect_same(
      "linear_extrude(2) polygon([[0,0],[9,0],[9,9],[0,9],[3,3],[6,3],[6,6],[3,6]], "
      "paths = [[0,1,2,3],[4,5,6,7]]);",
      "difference() { cube([9, 9, 2]); translate([3, 3, -1]) cube([3, 3, 4]); }");
  // A star drawn in one stroke, whose middle is enclosed twice.
  const Model star = evaluated(
                         "linear_extrude(2) polygon([[0,10],[5.9,-8.1],[-9.5,3.1],[9.5,3.1],"
                         "[-5.9,-8.1]]);")
                         .model;
  EXPECT_FALSE(Inside(star)({0, 0, 1}));
  EXPECT_TRUE(Inside(star)({0, 8, 1}));
}

TEST(Polygon, ListsThatAreNoneAreSaid) {
  EXPECT_EQ(evaluated("linear_extrude(2) polygon([[0, 0], [1, 0], 7]);").warnings.size(), 1u);
  EXPECT_EQ(evaluated("linear_extrude(2) polygon(7);").warnings.size(), 1u);
  EXPECT_EQ(
      evaluated("linear_extrude(2) polygon([[0,0],[1,0],[0,1]], [[0,1,2,3]]);").warnings.size(),
      1u);
  expect_same("linear_extrude(2) polygon([[0,0],[1,0],[0,1]], [[0,1,9,2,-1,nan]]);",
              "linear_extrude(2) polygon([[0,0],[1,0],[0,1]]);");
  expect_same("linear_extrude(2) polygon([[0,0],[1,0],[0,1]], []);",
              "linear_extrude(2) polygon([[0,0],[1,0],[0,1]]);");
}

TEST(FlatOperations, AreOpenscads) {
  expect_same("linear_extrude(2) offset(delta = 1) square(4);",
              "translate([-1, -1, 0]) cube([6, 6, 2]);");
  expect_same("linear_extrude(2) offset(r = -1) square(4);",
              "translate([1, 1, 0]) cube([2, 2, 2]);");
  expect_same("linear_extrude(2) offset(delta = 0) square(4);", "cube([4, 4, 2]);");
  expect_empty("linear_extrude(2) offset(-2) square(4);");
  expect_same("linear_extrude(2) fill() difference() { square(9); translate([2, 2]) square(3); }",
              "cube([9, 9, 2]);");
  expect_same("linear_extrude(2) hull() { square(1); translate([4, 4]) square(1); }",
              "linear_extrude(2) polygon([[0,0],[1,0],[5,4],[5,5],[4,5],[0,1]]);");
  expect_same("linear_extrude(2) minkowski() { square(3); group(); square([1, 2]); }",
              "cube([4, 5, 2]);");
  expect_same(
      "linear_extrude(2) resize([0, 20, 50], auto = true) translate([1, 1]) square([2, 4]);",
      "translate([5, 5, 0]) cube([10, 20, 2]);");
  expect_same("linear_extrude(2) rotate(90) offset(delta = 1) translate([2, 0]) square([2, 4]);",
              "translate([-5, 1, 0]) cube([6, 4, 2]);");
}

TEST(Dimensions, TheFirstChildDecides) {
  const Read solid = evaluated("cube(3); square(9); square(8); translate([5, 0, 0]) cube(1);");
  EXPECT_EQ(bounds(solid.model).box, (Box{{0, 0, 0}, {6, 3, 3}}));
  ASSERT_EQ(solid.warnings.size(), 1u);
  EXPECT_EQ(
      solid.warnings[0],
      "t.csg:1:1: warning: flat shapes and solids do not mix: the first one is solid, so flat "
      "shapes are left out");
  EXPECT_FALSE(solid.unsupported) << "OpenSCAD does the same";
  const Read flat = evaluated("square(3); cube(9);");
  EXPECT_EQ(seen_box(flat.model, bounds(flat.model).box), (Box{{0, 0, 0}, {3, 3, 0}}));
  // A group of nothing has no dimension, an empty shape has.
  expect_same("difference() { group() group(); } cube(3); square(9);", "cube(3);");
  expect_empty("square(0); cube(3);");
  // What is left out is an operand.
  expect_empty("intersection() { cube(3); square(3); }");
  expect_same("difference() { cube(3); square(3); }", "cube(3);");
  expect_empty("linear_extrude(3) union() { cube(1); square(2); }");
  expect_same("linear_extrude(3) { cube(1); square(2); }", "cube([2, 2, 3]);");
}

RC_GTEST_PROP(LinearExtrude, OfABooleanIsTheBooleanOfExtrusions, ()) {
  const auto shape = [] {
    const int x = *rc::gen::inRange(-3, 4), y = *rc::gen::inRange(-3, 4);
    const int size = *rc::gen::inRange(1, 5);
    const std::string leaf =
        *rc::gen::element<std::string>("square(", "circle($fn = 5, r = ", "circle(r = ");
    return "translate([" + std::to_string(x) + ", " + std::to_string(y) + "]) " + leaf +
           std::to_string(size) + ");";
  };
  const std::string a = shape(), b = shape(), c = shape();
  const std::string op = *rc::gen::element<std::string>("union", "difference", "intersection");
  const std::string e = "linear_extrude(2) ";
  // With a polygon engine and without.
  const Model exact = evaluated(e + op + "() { " + a + b + c + "}").model;
  const Model apart = evaluated(op + "() { " + e + a + e + b + e + c + "}").model;
  RC_ASSERT(differing_points(exact, apart, {{-8, -8, -1}, {8, 8, 3}}, 1000) == 0);
  ReadOptions facets;
  facets.curves = Curves::kFacets;
  const Model clipped =
      evaluated(e + "resize([0, 0]) " + op + "() { " + a + b + c + "}", facets).model;
  const Model embedded = evaluated(e + op + "() { " + a + b + c + "}", facets).model;
  RC_ASSERT(differing_points(clipped, embedded, {{-8, -8, -1}, {8, 8, 3}}, 1000) == 0);
}

}  // namespace
}  // namespace whittle

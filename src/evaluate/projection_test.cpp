#include "evaluate/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "evaluate/evaluate_test_support.h"
#include "flat/polygons_for_test.h"

namespace whittle {
namespace {

const std::string kBox = "translate([0, 0, -5]) cube([20, 20, 10]);";

void expect_projection(const std::string& projected, const std::string& flat) {
  expect_same("linear_extrude(3) " + projected, "linear_extrude(3) { " + flat + " }");
}

TEST(Projection, CutIsWhatLiesInThePlane) {
  expect_projection("projection(cut = true) " + kBox, "square(20);");
  expect_projection("projection(cut = true) difference() { " + kBox +
                        " translate([5, 5, -9]) cube([5, 5, 20]); }",
                    "difference() { square(20); translate([5, 5]) square(5); }");
  expect_projection("projection(cut = true) rotate([45, 0, 0]) cube([3, 10, 10], center = true);",
                    "square([3, 14.142135623730951], center = true);");
  expect_empty("linear_extrude(3) projection(cut = true) translate([0, 0, 1]) cube(4);");
}

TEST(Projection, CutTakesWhatOnlyTouchesThePlane) {
  expect_projection("projection(cut = true) cube(4);", "square(4);");
  expect_projection("projection(cut = true) translate([0, 0, -4]) cube(4);", "square(4);");
  expect_projection("projection(cut = true) linear_extrude(2) { square(4); circle(1, $fn = 4); }",
                    "square(4); circle(1, $fn = 4);");
  // So does the bottom of a hole, from above or below.
  for (const char* z : {"0", "-9"}) {
    expect_projection("projection(cut = true) difference() { " + kBox + " translate([5, 5, " + z +
                          "]) cube(9); }",
                      "difference() { square(20); translate([5, 5]) square(9); }");
  }
  // An edge has no area.
  expect_empty("linear_extrude(3) projection(cut = true) rotate([45, 0, 0]) cube(4);");
}

TEST(Projection, CutKnowsWhatCoincidesWithThePlane) {
  // A tenth of the tolerance above it, or below.
  for (const char* z : {"1e-6", "-1e-6"}) {
    expect_projection("projection(cut = true) translate([0, 0, " + std::string(z) + "]) cube(4);",
                      "square(4);");
  }
  expect_empty("linear_extrude(3) projection(cut = true) translate([0, 0, 1e-3]) cube(4);");
}

TEST(Projection, CutOfAllKindsOfSolids) {
  const std::string square = "square(4);";
  for (const std::string text :
       {"hull() { cube(4); difference() { cube(4); translate([1, 1, 1]) cube(9); } }",
        "minkowski() { cube(3); cube(1); }",
        "minkowski() { cube([3, 3, 1]); difference() { cube(1); translate([-1, -1, 0.5]) cube(9); "
        "} }",
        "resize([4, 4, 0]) difference() { cube(2); translate([-1, -1, 1]) cube(9); }",
        "intersection() { cube(4); translate([0, 0, -1]) cube(8); }",
        "linear_extrude(5, twist = 90, slices = 3) { square(4); }",
        "mirror([1, 0, 0]) translate([-4, 0, -1]) cube(4);",
        "difference() { cube(4); difference() { cube(4); translate([-1, -1, -1]) cube(9); } }"})
    expect_projection("projection(cut = true) " + text, square);
  // A ring aslant is cut in two.
  const std::string ring =
      "rotate([90, 0, 0]) rotate_extrude($fn = 16) translate([5, 0]) square(2);";
  expect_projection("projection(cut = true) " + ring,
                    "translate([5, -2]) square(2); translate([-7, -2]) square(2);");
  const Read read = evaluated("linear_extrude(3) projection(cut = true) halfspace([0, 0, 1], 0);");
  EXPECT_EQ(read.warnings.size(), 1u);
}

TEST(Projection, ShadowIsWhereAnythingIs) {
  expect_projection("projection() { cube(4); translate([9, 0, 50]) cube(3); }",
                    "square(4); translate([9, 0]) square(3);");
  expect_projection("projection() difference() { cube(9); translate([2, 2, 1]) cube(5); }",
                    "square(9);");
  expect_projection(
      "projection() difference() { cube(9); translate([2, 2, -1]) cube([5, 5, 20]); }",
      "difference() { square(9); translate([2, 2]) square(5); }");
  // The hole of a ring that is seen aslant.
  const Model ring =
      evaluated(
          "linear_extrude(1) projection() rotate([45, 0, 0]) rotate_extrude($fn = 32) "
          "translate([10, 0]) circle(2, $fn = 16);")
          .model;
  const Inside inside(ring);
  EXPECT_FALSE(inside({0, 0, 0.5}));
  EXPECT_TRUE(inside({10, 0, 0.5}));
  EXPECT_TRUE(inside({0, 8, 0.5}));
  EXPECT_FALSE(inside({0, 9.5, 0.5}));
}

/// Each point of the shadow has something above or below it, and no other has.
TEST(Projection, ShadowIsItsDefinition) {
  const std::string solid =
      "difference() { union() { rotate([20, 30, 10]) cube([9, 7, 5]); rotate([80, 0, 40]) "
      "cylinder(h = 20, r = 3, center = true, $fn = 9); } rotate([0, 50, 0]) cylinder(h = 40, r = "
      "2, "
      "center = true, $fn = 7); translate([0, 0, -20]) rotate([3, 0, 0]) cylinder(h = 40, r = 1.5, "
      "$fn = 5); }";
  const Model body = evaluated(solid).model;
  const Model shadow = evaluated("linear_extrude(1) projection() " + solid).model;
  const Inside in_body(body), in_shadow(shadow);
  const Box box = bounds(body).box;
  Points points(box);
  int seen = 0;
  for (int i = 0; i < 1500; ++i) {
    Vec3 p = points.next();
    const bool is_seen = in_shadow({p.x, p.y, 0.5});
    seen += is_seen;
    bool has_any = false;
    for (int k = 0; k <= 4000 && !has_any; ++k) {
      p.z = box.lo.z + (box.hi.z - box.lo.z) * k / 4000;
      has_any = in_body(p);
    }
    // A ray through a corner may be too short within to be found.
    if (has_any) {
      EXPECT_TRUE(is_seen) << p.x << " " << p.y;
    }
    if (!has_any && is_seen) --seen;
  }
  EXPECT_GT(seen, 300);
}

TEST(Projection, IsFlatForAllThatTakesFlatShapes) {
  expect_projection("offset(delta = 1) projection() cube(4);", "translate([-1, -1]) square(6);");
  expect_projection("hull() { projection() cube(1); translate([5, 0]) square(1); }",
                    "square([6, 1]);");
  expect_same("rotate_extrude($fn = 8) projection(cut = true) translate([4, 0, -1]) cube(3);",
              "rotate_extrude($fn = 8) translate([4, 0]) square(3);");
  expect_projection("mirror([1, 0]) projection() cube([2, 3, 4]);",
                    "translate([-2, 0]) square([2, 3]);");
  expect_same("hull() { linear_extrude(2) projection() cube(4); }", "cube([4, 4, 2]);");
  expect_projection("projection() linear_extrude(3) projection() cube(4);", "square(4);");
  expect_empty("linear_extrude(3) projection() square(4);");
  expect_empty("linear_extrude(3) projection();");
}

TEST(Projection, AtTheTopIsADrawingWithOutlines) {
  ReadOptions options = with_boundaries();
  options.outlines = true;
  size_t asked = 0;
  options.closed_mesh = [&, make = options.closed_mesh](const Model& model, size_t& pieces) {
    ++asked;
    return make(model, pieces);
  };
  const Model model =
      evaluated("translate([5, 0, 0]) projection() cube(4); projection(cut = true) cube(2);",
                options)
          .model;
  ASSERT_TRUE(model.drawing);
  EXPECT_NEAR(area(Polygons{model.drawing->outlines}), 20, 1e-9);
  EXPECT_EQ(asked, 1u) << "a cut needs no boundary, and the second walk none";
  EXPECT_EQ(model.primitives.size(), 2u);
}

TEST(Projection, HasFacetsForTrueCurves) {
  for (const Curves curves : {Curves::kAuto, Curves::kFacets, Curves::kSmooth}) {
    ReadOptions options = with_boundaries();
    options.curves = curves;
    const Model model =
        evaluated(
            "linear_extrude(2) projection() { sphere(10, $fa = 30, $fs = 20); translate([30, 0, "
            "0]) "
            "linear_extrude(2) circle(10, $fa = 30, $fs = 20); translate([60, 0, 0]) "
            "rotate_extrude($fa = 30, $fs = 20) square([10, 3]); }",
            options)
            .model;
    ASSERT_EQ(model.primitives.size(), 1u);
    // OpenSCAD's five sides, thrice.
    ASSERT_TRUE(std::holds_alternative<Mesh>(model.primitives[0].shape));
    EXPECT_EQ(plane_count(model.primitives[0].shape), 3u * 5 + 2);
  }
}

TEST(Projection, OfWhatHasNoEndIsLeftOut) {
  const Read read = evaluated("linear_extrude(3) projection() halfspace([0, 0, 1], 0);");
  EXPECT_TRUE(bounds(read.model).box.is_empty());
  ASSERT_TRUE(read.unsupported);
  EXPECT_EQ(read.unsupported->where, (SourceLocation{1, 19}));
}

}  // namespace
}  // namespace whittle

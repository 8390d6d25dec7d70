#include "subdivide/solid_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/rotation.h"
#include "lower/evaluate.h"
#include "lower/lower.h"
#include "subdivide/leaf.h"
#include "subdivide/simplify.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

SolidBounds bounds_of(const std::string& text) {
  return solid_bounds(*lower(model_of(text)), 1);
}

void expect_box(const std::string& text, const Box& box, double error = 0) {
  const SolidBounds found = bounds_of(text);
  ASSERT_FALSE(found.box.is_empty()) << text;
  EXPECT_TRUE(found.bounded) << text;
  EXPECT_TRUE(found.exact) << text;
  if (error == 0) error = kBoundsAccuracy * max_component(box.size());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found.box.lo[axis], box.lo[axis], error) << text << " axis " << axis;
    EXPECT_NEAR(found.box.hi[axis], box.hi[axis], error) << text << " axis " << axis;
  }
}

TEST(SolidBounds, WhatASubtractionTakesOffAnEndIsNotInTheBox) {
  expect_box("difference(){ cube(10); translate([-1,-1,4]) cube(20); }", {{0, 0, 0}, {10, 10, 4}});
  expect_box("difference(){ sphere(10); translate([-20,-20,5]) cube(40); }",
             {{-10, -10, -10}, {10, 10, 5}});
  expect_box("difference(){ cylinder(h=10,r=5); translate([0,-9,-1]) cube([9,18,18]); }",
             {{-5, -5, 0}, {0, 5, 10}});
}

TEST(SolidBounds, FacettedBodiesAreExactToRounding) {
  expect_box("cube(10); translate([20,0,0]) cube([1,2,3]);", {{0, 0, 0}, {21, 10, 10}}, 1e-9);
  const double top = 10 * std::cos(std::acos(-1.0) / 2 / 12);  // 24 meridians have 12 rings
  expect_box("difference(){ sphere(10,$fn=24); cylinder(h=30,r=1,center=true,$fn=8); }",
             {{-10 * std::cos(std::acos(-1.0) / 24), -10 * std::cos(std::acos(-1.0) / 24), -top},
              {10 * std::cos(std::acos(-1.0) / 24), 10 * std::cos(std::acos(-1.0) / 24), top}},
             1e-4);
}

TEST(SolidBounds, TheFarthestMayBeAPointALineACircleOrARidge) {
  const double r2 = std::sqrt(2.0);
  // A vertex, an edge along an axis, an edge along none.
  expect_box("rotate([45,0,0]) cube(10);", {{0, -10 / r2, 0}, {10, 10 / r2, 10 * r2}});
  expect_box("rotate([0,0,45]) rotate([45,0,0]) cube(10,center=true);",
             {{-5 / r2 - 5, -5 / r2 - 5, -5 * r2}, {5 / r2 + 5, 5 / r2 + 5, 5 * r2}}, 1e-4);
  // The rim of a hole in a ball.
  expect_box("difference(){ sphere(10); cylinder(h=30,r=6,center=true); }",
             {{-10, -10, -8}, {10, 10, 8}});
  // The back of a cylinder that lies across the axes.
  expect_box(
      "rotate([0,0,30]) rotate([0,90,0]) cylinder(h=20,r=5,center=true);",
      {{-10 * std::cos(std::acos(-1.0) / 6) - 2.5, -5 - 5 * std::cos(std::acos(-1.0) / 6), -5},
       {10 * std::cos(std::acos(-1.0) / 6) + 2.5, 5 + 5 * std::cos(std::acos(-1.0) / 6), 5}});
  expect_box("cylinder(h=10,r1=5,r2=0);", {{-5, -5, 0}, {5, 5, 10}});
}

TEST(SolidBounds, ShellsAndIntersectionsOfManySizes) {
  expect_box("difference(){ sphere(10); sphere(9.999); }", {{-10, -10, -10}, {10, 10, 10}});
  expect_box("intersection(){ cube(1000,center=true); sphere(0.001); }",
             {{-0.001, -0.001, -0.001}, {0.001, 0.001, 0.001}}, 2e-7);
  expect_box("intersection(){ sphere(5); translate([9,0,0]) sphere(5); }",
             {{4, -std::sqrt(25 - 4.5 * 4.5), -std::sqrt(25 - 4.5 * 4.5)},
              {5, std::sqrt(25 - 4.5 * 4.5), std::sqrt(25 - 4.5 * 4.5)}},
             1e-4);
  expect_box("translate([1e6,0,0]) difference(){ cube(10); translate([-1,-1,5]) cube(20); }",
             {{1e6, 0, 0}, {1e6 + 10, 10, 5}});
}

TEST(SolidBounds, ThinSkinsDoNotCount) {
  for (const char* text :
       {"", "difference(){ cube(10); cube(10); }", "difference(){ sphere(10); sphere(10); }",
        "intersection(){ cube(10); translate([10,0,0]) cube(10); }",
        "difference(){ union(){ cube(10); translate([5,5,5]) cube(10); } cube(10);"
        " translate([5,5,5]) cube(10); }",
        "rotate([10,20,30]) difference(){ cube(10); translate([-1,-1,-1]) cube(12); }",
        "difference(){ rotate([10,20,30]) cylinder(h=9,r=3); rotate([10,20,30])"
        " cylinder(h=9,r=3); }"})
    EXPECT_TRUE(bounds_of(text).box.is_empty()) << text;
  expect_box("cube(1); intersection(){ cube(10); translate([10,0,0]) cube(10); }",
             {{0, 0, 0}, {1, 1, 1}});
  expect_box("cube(1); difference(){ cube(10); cube(10); }", {{0, 0, 0}, {1, 1, 1}});
}

TEST(SolidBounds, HalfSpacesMayBeBoundedTogether) {
  std::string octahedron = "intersection(){";
  for (const char* n :
       {"1,1,1", "-1,1,1", "1,-1,1", "-1,-1,1", "1,1,-1", "-1,1,-1", "1,-1,-1", "-1,-1,-1"})
    octahedron += "halfspace(n=[" + std::string(n) + "],d=3);";
  expect_box(octahedron + "}", {{-3, -3, -3}, {3, 3, 3}});
  EXPECT_FALSE(bounds_of("halfspace(n=[0,0,1],d=0);").bounded);
  EXPECT_FALSE(bounds_of("difference(){ halfspace(n=[1,2,3],d=0); cube(10); }").bounded);
  EXPECT_TRUE(bounds_of("intersection(){ cube(10); halfspace(n=[1,2,3],d=0); }").bounded);
}

TEST(SolidBounds, WhereWorkIsCutShortTheBoxIsTooLargeRatherThanTooSmall) {
  const Scene scene =
      *lower(model_of("difference(){ sphere(10); cylinder(h=30,r=6,center=true); }"));
  double last = INFINITY;
  for (const size_t cells : {1, 3, 9, 27, 100000}) {
    const SolidBounds found = solid_bounds(scene, 1, cells);
    EXPECT_EQ(found.exact, cells == 100000) << cells;
    EXPECT_GE(found.box.hi.z, 8 - 20 * kBoundsAccuracy);
    EXPECT_LE(found.box.hi.z, last);
    if (cells == 1) {
      EXPECT_GT(found.box.hi.z, 9);
    }
    last = found.box.hi.z;
  }
  EXPECT_NEAR(last, 8, 20 * kBoundsAccuracy);
}

/// Whether the solid has a point in the box: cells halved until the middle of one is in the solid,
/// or none is left that is larger than `smallest`.
bool has_solid_in(const Scene& scene, const Box& box, double smallest) {
  if (box.is_empty()) return false;
  struct Item {
    Box box;
    Formula formula;
  };
  const UnitBoxes boxes(scene);
  Simplifier simplifier(scene, boxes, 0);
  LeafAnalysis leaf(scene);
  std::vector<Item> stack{{box, scene.formula}};
  while (!stack.empty()) {
    const Item item = std::move(stack.back());
    stack.pop_back();
    Item low;
    const Truth truth = simplifier.simplify(item.formula, item.box, Expand::kUnits, low.formula);
    if (truth == Truth::kFalse) continue;
    if (truth == Truth::kTrue || contains(scene, low.formula, item.box.center())) return true;
    leaf.analyse(low.formula);
    if (leaf.size() == 0 && !leaf.constant_value()) continue;
    const Vec3 size = item.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (size[axis] < smallest) continue;
    Item high = low;
    low.box = high.box = item.box;
    low.box.hi[axis] = high.box.lo[axis] = item.box.center()[axis];
    stack.push_back(std::move(high));
    stack.push_back(std::move(low));
  }
  return false;
}

/// What of `outer` lies beyond a side of `inner`, or up to `inset` before it.
Box beyond(const Box& outer, const Box& inner, int axis, bool high, double inset) {
  Box slab = outer;
  if (high)
    slab.lo[axis] = inner.hi[axis] - inset;
  else
    slab.hi[axis] = inner.lo[axis] + inset;
  return slab.is_empty() ? Box{} : slab;
}

TEST(SolidBounds, RandomTreesReachTheSidesAndNothingBeyond) {
  int checked = 0, empty = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const bool coincident = seed % 3 == 0;
    const Scene scene =
        *lower(model_of(random_tree(seed, {.primitives = 12, .coincident = coincident})));
    const SolidBounds found = solid_bounds(scene, 1);
    if (found.box.is_empty()) {
      ++empty;
      const double edge = scene.region.is_empty() ? 0 : max_component(scene.region.size());
      EXPECT_FALSE(has_solid_in(scene, scene.region, 1e-2 * edge)) << seed;
      continue;
    }
    EXPECT_TRUE(found.bounded && found.exact) << seed;
    const Box box{found.box.lo - scene.origin, found.box.hi - scene.origin};
    const double edge = max_component(box.size());
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        const Box outside = beyond(scene.region, box, axis, high, -4 * kBoundsAccuracy * edge);
        const Box inside = beyond(scene.region, box, axis, high, 1e-4 * edge);
        EXPECT_FALSE(has_solid_in(scene, outside, 1e-2 * edge))
            << "seed " << seed << " axis " << axis << (high ? " high" : " low");
        EXPECT_TRUE(has_solid_in(scene, inside, 1e-5 * edge))
            << "seed " << seed << " axis " << axis << (high ? " high" : " low");
        ++checked;
      }
  }
  EXPECT_GT(checked, 1000);
  EXPECT_GT(empty, 0);
}

TEST(SolidBounds, DoesNotDependOnTheNumberOfThreads) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const Scene scene = *lower(model_of(random_tree(seed, {.primitives = 40})));
    EXPECT_EQ(solid_bounds(scene, 1).box, solid_bounds(scene, 4).box) << seed;
  }
}

double reach_of(const std::string& text, Vec3 direction) {
  const Scene scene = *lower(model_of(text));
  return solid_reach(scene, solid_bounds(scene, 1).box, std::span(&direction, 1), 1).front();
}

TEST(SolidReach, IsKnownOfSimpleBodies) {
  const Vec3 d{1, -2, 3};
  const double length_of_d = length(d);
  EXPECT_NEAR(reach_of("cube([10, 20, 30]);", d), 10 + 90, 0.01);
  EXPECT_NEAR(reach_of("translate([1, 2, 3]) sphere(10);", d), 1 - 4 + 9 + 10 * length_of_d, 0.01);
  EXPECT_NEAR(reach_of("cylinder(h = 10, r = 4);", d), 30 + 4 * std::hypot(1, 2), 0.01);
  EXPECT_NEAR(reach_of("cylinder(h = 10, r = 4);", {0, 0, -2}), 0, 0.01) << "along an axis";
}

TEST(SolidReach, IsThatOfWhatIsLeft) {
  // A corner cut off by a plane through the middles of three edges.
  EXPECT_NEAR(reach_of("intersection() { cube(10); halfspace(n = [1, 1, 1], d = 25); }", {1, 1, 1}),
              25, 0.01);
  // A ball without its upper half.
  EXPECT_NEAR(
      reach_of("difference() { sphere(10); translate([-20, -20, 0]) cube(40); }", {1, 0, 1}), 10,
      0.02);
}

TEST(SolidReach, InTurnedDirectionsIsTheBoxOfTheTurnedBody) {
  const std::string part =
      "difference() { union() { cube([30, 20, 8]); translate([15, 10, 8]) sphere(7); }"
      " translate([15, 10, -1]) cylinder(h = 40, r = 3); translate([-1, -1, 5]) cube([9, 9, 9]); }";
  const SolidBounds turned = bounds_of("rotate([30, 40, 50]) {" + part + "}");
  const Affine turn = rotation(50, {0, 0, 1}) * rotation(40, {0, 1, 0}) * rotation(30, {1, 0, 0});
  for (int axis = 0; axis < 3; ++axis) {
    // What lies along an axis once it is turned.
    Vec3 along;
    for (int k = 0; k < 3; ++k) {
      Vec3 unit;
      unit[k] = 1;
      along[k] = turn.vector(unit)[axis];
    }
    EXPECT_NEAR(reach_of(part, along), turned.box.hi[axis], 1e-3 * 30) << axis;
    EXPECT_NEAR(-reach_of(part, along * -1), turned.box.lo[axis], 1e-3 * 30) << axis;
  }
}

TEST(SolidReach, OfNothingIsNothing) {
  const Scene scene = *lower(model_of("difference() { cube(10); cube(10); }"));
  const Vec3 up{0, 0, 1};
  EXPECT_EQ(solid_reach(scene, {}, std::span(&up, 1), 1).front(), -kInfinity);
}

}  // namespace
}  // namespace whittle

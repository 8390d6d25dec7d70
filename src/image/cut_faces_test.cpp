#include "image/cut_faces.h"

#include <gtest/gtest.h>

#include "lower/lower.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Cut or not at a point of the surface of primitive `id`.
bool is_cut(const char* text, uint32_t id, Vec3 point) {
  const Scene scene = *lower(model_of(text));
  const CutFaces faces(scene);
  WHITTLE_CHECK(faces.is_contested(id));
  return faces.is_cut(id, point);
}

TEST(CutFaces, WithoutCoincidenceNothingIsContested) {
  const Scene scene = *lower(model_of("difference(){ cube(10); translate([5,5,5]) cube(10); }"));
  const CutFaces faces(scene);
  for (const uint32_t id : {0, 1, 2, 3, 99}) EXPECT_FALSE(faces.is_contested(id));
}

TEST(CutFaces, FacesOfOneSignAreNotContested) {
  const Scene scene =
      *lower(model_of("difference(){ union(){ cube(10); translate([10,0,0]) cube(10); }"
                      " translate([5,5,5]) cube(10); translate([15,5,5]) cube(10); }"));
  const CutFaces faces(scene);
  for (const uint32_t id : {1, 2, 3, 4}) EXPECT_FALSE(faces.is_contested(id));
}

// The pictures of openscad 2021.01 --render: tests/openscad.
TEST(CutFaces, ACutterThatTouchesFromOutsideTakesTheFaceAlong) {
  const char* text = "difference(){ cube(10); translate([0,0,10]) cube([5,10,10]); }";
  EXPECT_TRUE(is_cut(text, 1, {2, 5, 10}));
  EXPECT_FALSE(is_cut(text, 1, {8, 5, 10}));
  EXPECT_FALSE(is_cut(text, 1, {8, 0, 5}));
}

TEST(CutFaces, ABodyHoldsItsEdgesWhateverRoundingSays) {
  const char* text = "difference(){ cube(10); translate([0,0,10]) cube([5,10,10]); }";
  for (const double off : {-1e-12, 0.0, 1e-12}) {
    EXPECT_FALSE(is_cut(text, 1, {8, off, 10}));
    EXPECT_FALSE(is_cut(text, 1, {10 - off, 5, 10}));
  }
}

TEST(CutFaces, MaterialOnACutGivesTheFaceBack) {
  const char* text =
      "union(){ difference(){ cube(10); translate([0,0,5]) cube(20); }"
      " translate([2,2,0]) cube([4,4,5]); }";
  EXPECT_TRUE(is_cut(text, 2, {8, 8, 5}));
  EXPECT_FALSE(is_cut(text, 2, {4, 4, 5}));
}

TEST(CutFaces, AnIntersectionHoldsWhatBothHold) {
  for (const char* text :
       {"intersection(){ difference(){ cube(10); translate([0,0,5]) cube(20); }"
        " translate([2,2,0]) cube([20,20,5]); }",
        "translate([100,0,0]) cube(1); intersection(){ translate([2,2,0])"
        " cube([20,20,5]); difference(){ cube(10); translate([0,0,5]) cube(20); } }"})
    EXPECT_TRUE(is_cut(text, 2, {4, 4, 5})) << text;
}

TEST(CutFaces, TheWallThatACutterLostIsNotTakenAlong) {
  // The cutter is a pipe as high as what it cuts, of which it leaves a core.
  const char* text =
      "difference(){ cylinder(h=10,r=5); difference(){ cylinder(h=10,r=9); cylinder(h=10,r=4); } }";
  for (const double r : {4.0, 4.000001, 3.999999}) EXPECT_FALSE(is_cut(text, 3, {r, 0, 7})) << r;
  // The core's top is the first cylinder's, the pipe's, and that of what the pipe lacks.
  EXPECT_FALSE(is_cut(text, 1, {0, 0, 10}));
}

}  // namespace
}  // namespace whittle

// Lowering and the oracle find out which faces lie on one surface each in its own way: by a table
// of fingerprints over half-spaces, and by comparing every face with every surface. They must find
// the same.
#include <gtest/gtest.h>

#include "lower/lower.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/oracle/surfaces.h"

namespace whittle {
namespace {

/// Counts the faces that share a surface with an earlier one.
size_t expect_same_names(const std::string& text) {
  const Model model = model_of(text);
  const Scene scene = *lower(model);
  if (scene.region.is_empty()) return 0;  // nothing can be seen, so nothing is named
  const Surfaces surfaces = name_surfaces(model, instances(model));
  EXPECT_EQ(scene.half_spaces.size(), surfaces.all.size()) << text;
  EXPECT_EQ(scene.faces.size(), surfaces.faces.size()) << text;
  if (scene.faces.size() != surfaces.faces.size()) return 0;
  for (size_t i = 0; i < scene.faces.size(); ++i) {
    const SurfaceFace& face = surfaces.faces[i];
    EXPECT_EQ(scene.faces[i].literal >> 1, face.surface) << "face " << i << " of\n" << text;
    if (surfaces.all[face.surface].kind == Surface::Kind::kPlane) {
      EXPECT_EQ(bool(scene.faces[i].literal & 1), face.other_side) << "face " << i << " of\n"
                                                                   << text;
    }
  }
  return scene.faces.size() - scene.half_spaces.size();
}

TEST(Naming, LoweringAndOracleFindTheSameSurfaces) {
  size_t shared = 0;
  for (uint64_t seed = 1; seed <= 1000; ++seed) {
    shared += expect_same_names(random_tree(seed, {.primitives = 24, .coincident = true}));
    shared += expect_same_names(
        random_tree(seed, {.primitives = 24, .coincident = true, .nearly = true}));
    shared += expect_same_names(random_tree(seed, {.primitives = 24}));
  }
  EXPECT_GT(shared, 20000u);
}

TEST(Naming, WhatWasWrittenOnOneSurfaceStaysOnOne) {
  // A block and a thin drill whose bottoms are equal, and one a little lower: by the block's
  // tolerance all three are one, by the drill's not.
  const std::string part =
      "difference() { translate([0, 0, 1.00002]) cube([10, 10, 2]);"
      "translate([5, 5, 1.00002]) cylinder(h = 2, r = 0.005); }";
  EXPECT_EQ(expect_same_names("translate([12, 0.5, 1]) cube(1);" + part), 3u);
  // Too much lower for the block: then only their own tops and bottoms are shared.
  EXPECT_EQ(expect_same_names("translate([12, 0.5, 0.999]) cube(1);" + part), 2u);
}

TEST(Naming, CirclesOnTheTwoNappesOfAConeAreNoWallOfIt) {
  // Both circles of the second lie on the first one's double cone, before its tip and behind it.
  const std::string cone = "cylinder(h = 6, r1 = 2, r2 = 0); ";
  // Only the discs below are one plane.
  EXPECT_EQ(expect_same_names(cone + "cylinder(h = 18, r1 = 2, r2 = 4);"), 1u);
  EXPECT_EQ(expect_same_names(cone + "cylinder(h = 18, r1 = 2, r2 = 0);"), 1u);
  // Flat ones, whose surfaces hardly differ as numbers.
  EXPECT_EQ(expect_same_names("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,0.01,0],[0,0,0,1]]) {"
                              "cylinder(h = 1, r1 = 0, r2 = 1, center = true);"
                              "cylinder(h = 3, r1 = 1, r2 = 0, center = true);"
                              "translate([5, 0, 0]) cylinder(h = 1, r1 = 2, r2 = 1); }"),
            0u);
  // A piece of the same nappe is the same wall.
  EXPECT_EQ(expect_same_names(cone + "cylinder(h = 3, r1 = 2, r2 = 1);"), 2u);
}

}  // namespace
}  // namespace whittle

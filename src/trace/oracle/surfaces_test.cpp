#include "trace/oracle/surfaces.h"

#include <gtest/gtest.h>

#include "support/read_text.h"

namespace whittle {
namespace {

Surfaces named(const std::string& text) {
  const Model model = model_of(text);
  return name_surfaces(model, instances(model));
}

/// The surface of every face, and whether it is looked at from the other side.
std::vector<std::pair<uint32_t, bool>> faces(const std::string& text) {
  std::vector<std::pair<uint32_t, bool>> result;
  for (const SurfaceFace& face : named(text).faces)
    result.emplace_back(face.surface, face.other_side);
  return result;
}

TEST(Surfaces, OfOnePrimitiveAreItsFaces) {
  EXPECT_EQ(named("cube(1);").all.size(), 6u);
  EXPECT_EQ(named("sphere(1);").all.size(), 1u);
  EXPECT_EQ(named("cylinder(r=1,h=1);").all.size(), 3u);
  EXPECT_EQ(named("cube(0);").all.size(), 0u);
}

TEST(Surfaces, AbuttingCubesShareAPlaneFromBothSides) {
  const Surfaces s = named("cube(10); translate([10,0,0]) cube(10);");
  EXPECT_EQ(s.all.size(), 12u - 4u - 1u);
  int other = 0;
  for (const SurfaceFace& face : s.faces) other += face.other_side;
  EXPECT_EQ(other, 1);
}

TEST(Surfaces, WithinTheToleranceIsOneBeyondIsTwo) {
  // The tolerance is 2e-5.
  const std::string slab = "cube([10,10,1]); translate([0,0,", end = "]) cube([10,10,1]);";
  EXPECT_EQ(named(slab + "1.000019" + end).all.size(), 7u);
  EXPECT_EQ(named(slab + "1.000021" + end).all.size(), 8u);
  const std::string ball = "sphere(5); translate([", ball_end = ",0,0]) sphere(5);";
  EXPECT_EQ(named(ball + "0.000019" + ball_end).all.size(), 1u);
  EXPECT_EQ(named(ball + "0.000021" + ball_end).all.size(), 2u);
}

TEST(Surfaces, TheFirstInTheFileStandsForTheRestAndNoneChains) {
  const std::string text =
      "cube([10,10,1]); translate([0,0,1.000015]) cube([10,10,1]);"
      "translate([0,0,1.00003]) cube([10,10,2]); translate([0,0,0.999995]) cube([10,10,3]);";
  const auto all = faces(text);
  // Bottoms of the second, third and fourth: on the first's top (its last or last but one face)?
  int on_first = 0;
  for (size_t i = 6; i < all.size(); ++i) on_first += all[i].second && all[i].first < 6;
  EXPECT_EQ(on_first, 2);
}

TEST(Surfaces, ParallelIsJudgedOverThePrimitive) {
  // Turned by 1e-5: a cube of 1 parts by less than the tolerance (2e-4), one of 100 by more.
  const std::string turned =
      "cube(100); multmatrix([[1,0,0,0],[0,1,-1e-5,0],[0,1e-5,1,100],[0,0,0,1]]) cube(";
  const auto bottom_is_shared = [&](const std::string& size) {
    int shared = 0;
    for (const auto& [surface, other] : faces(turned + size + ");")) shared += other;
    return shared == 1;
  };
  EXPECT_TRUE(bottom_is_shared("1"));
  EXPECT_FALSE(bottom_is_shared("100"));
}

TEST(Surfaces, ConesThatMeetAtTheApexAreOneSurfaceOfTwoNappes) {
  const auto all = faces("cylinder(h=2,r1=0,r2=1); mirror([0,0,1]) cylinder(h=2,r1=0,r2=1);");
  EXPECT_EQ(all[0], (std::pair<uint32_t, bool>{0, false}));
  EXPECT_EQ(all[3], (std::pair<uint32_t, bool>{0, true}));
}

TEST(Surfaces, SphereAndCylinderAreNeverOne) {
  // The ring lies within the tolerance of the sphere's equator.
  EXPECT_EQ(named("sphere(10); cylinder(h=0.001,r=10,center=true);").all.size(), 4u);
}

}  // namespace
}  // namespace whittle

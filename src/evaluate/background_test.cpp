#include "evaluate/background.h"

#include "csg/test_support.h"
#include "model/instances.h"

namespace whittle {
namespace {

ReadOptions with_background() {
  ReadOptions options;
  options.background = true;
  return options;
}

std::string background_tree(std::string_view text) {
  const Read read = read_good(text, with_background());
  return read.model.background ? tree(*read.model.background) : "none";
}

TEST(Background, IsReadWhereItIsAskedForAlone) {
  EXPECT_EQ(read_good("%cube(1); sphere(2);").model.background, nullptr);
  EXPECT_EQ(background_tree("cube(1); sphere(2);"), "none");
  EXPECT_EQ(background_tree("%cube(1); sphere(2);"), "U(c1)");
}

TEST(Background, StandsWhereItIsWrittenInTheColorAroundIt) {
  const Read read = read_good(
      "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) color([1,0,0,1]) difference() {"
      "  cube(1); %color([0,1,0,1]) sphere(2); }",
      with_background());
  ASSERT_NE(read.model.background, nullptr);
  const Model& ghosts = *read.model.background;
  EXPECT_EQ(tree(ghosts), "U(T(P(P(s2))))");
  EXPECT_EQ(appearances(ghosts)[2].color, (Rgba{1, 0, 0, 1})) << "the outermost one wins";
  EXPECT_EQ(instances(ghosts)[0].world_from_object.translation, (Vec3{5, 0, 0}));
}

TEST(Background, OneWithinAnotherIsAnother) {
  EXPECT_EQ(background_tree("%difference() { cube(1); %sphere(2); cube(3); }"), "U(D(c1 c3) s2)");
}

TEST(Background, FlatShapesBecomeSolidsAsElsewhere) {
  EXPECT_EQ(background_tree("sphere(2); %linear_extrude(height = 3) square(2);"), "U(B2(c2))");
  EXPECT_EQ(background_tree("linear_extrude(height = 3) { square(2); %circle(9); }"), "none")
      << "of an extrusion nothing is seen but what it makes";
  const Read flat = read_good("cube(1); %square(2);", with_background());
  EXPECT_EQ(flat.model.background, nullptr);
  ASSERT_EQ(flat.warnings.size(), 1u);
  EXPECT_EQ(flat.warnings[0], "t.csg:1:11: warning: what % marks is flat; it is not drawn");
}

TEST(Background, ChangesNothingOfTheSolid) {
  const std::string_view text = "%cube(1); difference() { %sphere(3); cube(2); #sphere(1); }";
  EXPECT_EQ(tree(read_good(text, with_background()).model), tree(read_good(text).model));
}

}  // namespace
}  // namespace whittle

// What is flat at the top of a file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "evaluate/evaluate_test_support.h"
#include "model/instances.h"

namespace whittle {
namespace {

ReadOptions with_outlines() {
  ReadOptions options;
  options.curves = Curves::kOpenscad2021;
  options.outlines = true;
  return options;
}

using Outlines = std::vector<std::vector<Vec2>>;

Outlines outlines_of(const std::string& text) {
  const Read read = evaluated(text, with_outlines());
  EXPECT_TRUE(read.model.drawing) << text;
  return read.model.drawing ? read.model.drawing->outlines : Outlines{};
}

/// Counter-clockwise ones count, holes are taken off.
double enclosed_area(const Outlines& outlines) {
  double area = 0;
  for (const std::vector<Vec2>& outline : outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      area += cross(outline[i], outline[(i + 1) % outline.size()]) / 2;
    }
  }
  return area;
}

TEST(Drawing, IsWhatIsFlatAtTheTop) {
  EXPECT_TRUE(evaluated("square(3);").model.drawing);
  EXPECT_TRUE(evaluated("translate([1, 2, 3]) { square(3); cube(1); }").model.drawing);
  EXPECT_TRUE(evaluated("square(0);").model.drawing) << "empty, and flat";
  EXPECT_FALSE(evaluated("cube(3); square(3);").model.drawing);
  EXPECT_FALSE(evaluated("linear_extrude(1) square(3);").model.drawing);
  EXPECT_FALSE(evaluated("group();").model.drawing);
}

TEST(Drawing, EveryStatementKeepsItsIdAndColor) {
  const Model model =
      evaluated(
          "color(\"red\") square(3); translate([5, 0, 9]) difference() { circle(2); square(1); "
          "} offset(1) square(1);")
          .model;
  ASSERT_EQ(model.primitives.size(), 4u);
  EXPECT_EQ(model.primitives[0].id, 1u);
  EXPECT_EQ(model.primitives[1].id, 2u);
  EXPECT_EQ(model.primitives[3].id, 4u) << "the offset's";
  EXPECT_EQ(appearances(model)[1].color, (Rgba{1, 0, 0, 1}));
  EXPECT_TRUE(appearances(model)[3].cut);
}

TEST(Drawing, TheSlabIsAsThickAsSuitsItsSize) {
  for (const double size : {1e-9, 1.0, 1e6, 1e30}) {
    const Model scaled =
        evaluated(fmt::format("scale([{}, {}, 1]) square([2, 1]);", size, size)).model;
    const Box box = bounds(scaled).box;
    EXPECT_NEAR(box.size().x / size, 2, 1e-9);
    EXPECT_NEAR(box.size().z / size, 1.0 / 32, 1e-9);
    EXPECT_EQ(box.lo.z, -box.hi.z);
    // So that the tolerance is that of what was drawn.
    EXPECT_NEAR(tolerance(bounds(scaled)) / size, 4e-6, 1e-9);
  }
}

TEST(Drawing, OutlinesAreThoseOfAllTogether) {
  const Outlines cross = outlines_of("square([9, 3]); translate([3, -3, 7]) square([3, 9]);");
  ASSERT_EQ(cross.size(), 1u) << "what overlaps has no lines between";
  EXPECT_EQ(cross[0].size(), 12u);
  const Outlines ring = outlines_of("difference() { square(9); translate([3, 3]) square(3); }");
  ASSERT_EQ(ring.size(), 2u);
  EXPECT_EQ(enclosed_area(ring), 81 - 9);
  const Outlines circle = outlines_of("%square(99); scale([2, 1, 5]) circle(r = 1, $fn = 6.9);");
  ASSERT_EQ(circle.size(), 1u);
  EXPECT_EQ(circle[0].size(), 6u) << "that version cuts off the fraction";
  EXPECT_NEAR(enclosed_area(circle), 3 * std::sqrt(3.0), 1e-9);
}

TEST(Drawing, OutlinesAreMadeOnlyWhereTheyAreAskedFor) {
  EXPECT_TRUE(evaluated("square(3);").model.drawing->outlines.empty());
  const Read read =
      evaluated("square(3); projection() cube(1); text(\"a\", font = \"Nope\");", with_outlines());
  EXPECT_FALSE(read.model.drawing->outlines.empty());
  EXPECT_EQ(read.warnings.size(), 2u) << "nothing is said twice";
}

TEST(Drawing, OutlinesCountAsWork) {
  ReadOptions options = with_outlines();
  options.limits.facets = 60;
  EXPECT_EQ(evaluation_error("circle(r = 1, $fn = 50);", options), "no error");
  options.limits.facets = 1;
  std::string squares;
  for (int i = 0; i < 20; ++i) squares += "square(3);";
  EXPECT_NE(evaluation_error(squares, options).find("limit"), std::string::npos);
  options.outlines = false;
  EXPECT_EQ(evaluation_error(squares, options), "no error");
}

}  // namespace
}  // namespace whittle

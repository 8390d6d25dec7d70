#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "evaluate/convex_hull.h"
#include "evaluate/evaluate_test_support.h"

namespace whittle {
namespace {

TEST(SolidHull, KeepsTheCornersAndTheirPlanes) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(Box{{0, 0, 0}, {3, 4, 5}}.corner(i));
  points.push_back({1, 1, 1});
  points.push_back({3, 2, 2});
  points.push_back(points[0]);
  const std::optional<Polyhedron> hull = solid_hull(points);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->planes.size(), 6u);
  for (const Plane& plane : hull->planes) {
    EXPECT_EQ(length(plane.n), 1);
    EXPECT_EQ(std::fabs(plane.n.x) + std::fabs(plane.n.y) + std::fabs(plane.n.z), 1) << "exact";
  }
}

TEST(SolidHull, OfWhatIsFlatIsNone) {
  EXPECT_FALSE(solid_hull({}));
  EXPECT_FALSE(solid_hull(std::vector<Vec3>(9, {1, 2, 3})));
  EXPECT_FALSE(solid_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_FALSE(solid_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_FALSE(solid_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-9}}));
  EXPECT_FALSE(solid_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, kInfinity}}));
  EXPECT_FALSE(
      solid_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, std::nan("")}}));
}

RC_GTEST_PROP(SolidHull, HoldsAllPointsAndNothingBeyondTheirMixtures, ()) {
  const int n = *rc::gen::inRange(4, 60);
  const double size = *rc::gen::element(1.0, 1e-4, 1e6);
  const Vec3 offset = Vec3{1, 2, 3} * *rc::gen::element(0.0, 1000.0);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const auto x = [] { return *rc::gen::inRange(-5, 6); };
    points.push_back((Vec3{double(x()), double(x()), double(x())} + offset) * size);
  }
  const std::optional<Polyhedron> hull = solid_hull(points);
  RC_PRE(hull.has_value());
  for (const Plane& plane : hull->planes) {
    double most = -kInfinity;
    for (const Vec3 p : points) most = std::fmax(most, dot(plane.n, p) - plane.d);
    RC_ASSERT(most <= 1e-9 * size * length(offset + Vec3{9, 9, 9}));
    RC_ASSERT(most >= -1e-9 * size * length(offset + Vec3{9, 9, 9}));
  }
}

TEST(Hull, OfCubes) {
  expect_same("hull() { cube(1); translate([4, 0, 0]) cube(1); }", "cube([5, 1, 1]);");
  expect_same(
      "hull() { cube(1); translate([0, 0, 4]) hull() { cube(1); translate([2, 0, 0]) cube(1);"
      "} }",
      "polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,5],[3,0,5],[3,1,5],[0,1,5],[3,0,4],"
      "[3,1,4]], [[0,1,2,3],[4,5,8,1,0],[7,6,5,4],[5,6,9,8],[8,9,2,1],[6,7,3,2,9],[7,4,0,"
      "3]]);");
  const Model model = evaluated("cube(); hull() { cube(1); translate([4, 0, 0]) cube(1); }").model;
  ASSERT_EQ(model.primitives.size(), 2u);
  EXPECT_EQ(model.primitives[1].id, 2u);
  EXPECT_EQ(model.statement_count, 4u);
}

TEST(Hull, OfEverythingWhoseCornersAreKnown) {
  for (const char* part :
       {"cylinder(h = 3, r = 2, $fn = 7);", "cylinder(h = 3, r1 = 2, r2 = 0, $fn = 8);",
        "sphere(2, $fn = 9);", "sphere(2);", "linear_extrude(3) polygon([[0,0],[4,0],[1,3]]);",
        "scale([1, 2, 3]) rotate([10, 20, 30]) cube(2);",
        "polyhedron([[0,0,0],[3,0,0],[0,3,0],[0,0,3]], [[0,1,2],[0,3,1],[1,3,2],[2,3,0]]);",
        "minkowski() { cube(2); cylinder(h = 1, r = 1, $fn = 5); }",
        "resize([3, 0, 5]) sphere(1, $fn = 6);", "rotate_extrude($fn = 6) square([2, 3]);"}) {
    const std::string text = part;
    ReadOptions facets;
    facets.curves = Curves::kFacets;
    expect_same("hull() " + text, text, facets);
    const Read read = evaluated("hull() { color(\"red\") { " + text + "} group(); %cube(99); }");
    EXPECT_TRUE(read.warnings.empty()) << read.warnings[0];
    EXPECT_EQ(read.model.primitives.size(), 1u);
  }
}

TEST(Hull, ThatIsFlatIsEmptyAndAnOperand) {
  for (const char* text :
       {"hull();", "hull() group();", "hull() cube([1, 1, 0]);",
        "difference() { hull() { cube(0); } cube(1); }", "hull() { scale([1, 1, 0]) cube(1); }"}) {
    expect_empty(text);
  }
}

TEST(Hull, OfWhatIsCutIsThatOfWhatIsLeft) {
  expect_same(
      "hull() { cube(1); difference() { cube([9, 1, 1]); translate([4, -1, -1]) cube(9); } }",
      "cube([4, 1, 1]);");
  expect_same("hull() intersection() { cube(4); translate([1, 2, 3]) cube(9); }",
              "translate([1, 2, 3]) cube([3, 2, 1]);");
  expect_same("hull() { cube(1); difference() { translate([4, 0, 0]) cube(1); cube(9); } }",
              "cube(1);");
  expect_empty("hull() difference() { cube(1); cube(2); }");
  // Moved and mirrored, by what is around it and by what is in it.
  expect_same(
      "hull() translate([10, 0, 0]) mirror([1, 0, 0]) difference() { translate([1, 0, 0]) cube(4);"
      " cube([2, 9, 9]); }",
      "translate([5, 0, 0]) cube([3, 4, 4]);");
  // What is hulled in there comes first, and what is not cut is not asked for.
  size_t asked = 0;
  ReadOptions options = with_boundaries();
  options.closed_mesh = [&, make = options.closed_mesh](const Model& model, size_t& pieces) {
    ++asked;
    return make(model, pieces);
  };
  expect_same(
      "hull() { difference() { hull() { cube(1); difference() { cube([9, 1, 1]); translate([7, -1,"
      " -1]) cube(9); } } translate([5, -1, -1]) cube(9); } cube(1); union() { cube(1); } }",
      "cube([5, 1, 1]);", options);
  EXPECT_EQ(asked, 2u);
}

TEST(Hull, OfManyPiecesTakesOfTheBudgetOfAll) {
  ReadOptions options = with_boundaries();
  options.limits.facets = 10'000;
  size_t asked = 0;
  options.closed_mesh = [&, make = options.closed_mesh](const Model& model, size_t& pieces) {
    Result<TriangleMesh> mesh = make(model, pieces);
    ++asked;
    pieces = 4'000;  // as if much had been cut away
    return mesh;
  };
  const std::string one = "hull() difference() { cube(2); cube(1); }";
  EXPECT_EQ(bounds(evaluated(one + one, options).model).box, (Box{{0, 0, 0}, {2, 2, 2}}));
  std::string many;
  for (int i = 0; i < 20; ++i) many += one;
  asked = 0;
  const std::string error = evaluation_error(many, options);
  EXPECT_NE(error.find("more than the limit of 300000"), std::string::npos) << error;
  EXPECT_EQ(asked, 4u);
}

TEST(Hull, OfWhatHasNoEndIsLeftOut) {
  const Read read =
      evaluated("hull() { cube(1); difference() { halfspace([0, 0, 1], 0); cube(9); } }");
  EXPECT_EQ(bounds(read.model).box, (Box{{0, 0, 0}, {1, 1, 1}}));
  ASSERT_TRUE(read.unsupported);
  EXPECT_EQ(read.unsupported->where, (SourceLocation{1, 19}));
  // What is cut out of it has one.
  expect_same("hull() intersection() { halfspace([0, 0, 1], 1); cube(9); }", "cube([9, 9, 1]);");
}

TEST(Hull, WithoutBoundariesSaysSo) {
  ReadOptions options;
  const Result<Read> read =
      read_csg("hull() { cube(1); difference() { cube(4); cube(2); } }", "t.csg", options);
  ASSERT_TRUE(read);
  EXPECT_EQ(bounds(read->model).box, (Box{{0, 0, 0}, {1, 1, 1}}));
  ASSERT_TRUE(read->unsupported);
}

TEST(Hull, HasFacetsForTrueCurvesInWhatIsCut) {
  for (const Curves curves : {Curves::kAuto, Curves::kFacets, Curves::kSmooth}) {
    ReadOptions options = with_boundaries();
    options.curves = curves;
    const Model model =
        evaluated(
            "hull() difference() { union() { sphere(5); linear_extrude(9) circle(3); "
            "rotate_extrude() translate([4, 0]) circle(2); } translate([0, 0, -9]) cube([9, 9, "
            "9]); }",
            options)
            .model;
    ASSERT_EQ(model.primitives.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<Polyhedron>(model.primitives[0].shape));
  }
}

TEST(Resize, IsByTheBoxAndAboutTheOrigin) {
  expect_same("resize([10, 0, 0]) translate([1, 1, 1]) cube(2);",
              "translate([5, 1, 1]) cube([10, 2, 2]);");
  expect_same("resize([10, 20, 0], auto = [0, 0, 1]) translate([1, 1, 1]) cube(2);",
              "translate([5, 10, 10]) cube([10, 20, 20]);");
  expect_same("resize([-4, 0, 5], auto = true) cube(2);", "cube(5);");
  expect_same("resize([0, 0, 0], auto = true) cube(2);", "cube(2);");
  expect_same("resize([10, 5]) cube(2);", "cube([10, 5, 2]);");
  expect_same(
      "resize([4, 0, 0], auto = true) resize([9, 9, 9]) { cube(1); translate([1, 1, 1]) "
      "cube(2); }",
      "resize([4, 4, 4]) { cube(1); translate([1, 1, 1]) cube(2); }");
  const Model model = evaluated(
                          "color(\"red\") cube(); resize([3, 3, 3]) { color(\"blue\") sphere(); "
                          "translate([1, 0, 0]) cube(); } translate([1, 2, 3]) cube();")
                          .model;
  EXPECT_EQ(appearances(model)[3].color, (Rgba{0, 0, 1, 1})) << "it is no body";
  EXPECT_TRUE(bounds(evaluated("resize([3, 3, 3]);").model).box.is_empty());
}

TEST(Resize, AsksForTheExactBox) {
  ReadOptions options;
  size_t asked = 0;
  options.solid_box = [&](const Model& model) {
    EXPECT_EQ(model.primitives.size(), 2u);
    ++asked;
    return Box{{0, 0, 0}, {1, 2, 4}};
  };
  const Model model =
      evaluated("cube(5); resize([8, 0, 0]) difference() { cube(2); cube(1); }", options).model;
  EXPECT_EQ(asked, 1u);
  EXPECT_EQ(bounds(model).box, (Box{{0, 0, 0}, {16, 5, 5}}));
}

}  // namespace
}  // namespace whittle

#include "lines/line_drawing.h"

#include <cmath>
#include <numbers>

#include "lines/drawing_for_test.h"
#include "support/random_tree.h"

namespace whittle {
namespace {

/// From the front, the right and above, so that the three axes look alike.
const Vec3 kIsometric{std::atan(std::sqrt(2.0)) * 180 / std::numbers::pi, 0, 45};
constexpr double kFine = 0.025;  // millimetres
constexpr double kStep = 1e-3;

LineDrawing to_scale(const std::string& text, Vec3 degrees, bool hidden = true) {
  return drawing_of(model_of(text), orthographic_camera(degrees), {.hidden = hidden});
}

/// Where the isometric camera draws a point.
Vec2 isometric(double x, double y, double z) {
  return {(x + y) / std::sqrt(2.0), (x - y) / std::sqrt(6.0) - z * std::sqrt(2.0 / 3)};
}

bool has_point(const std::vector<DrawnPath>& paths, Vec2 p) {
  for (const DrawnPath& path : paths)
    for (const Vec2 q : path.points)
      if (length(p - q) < kStep) return true;
  return false;
}

TEST(LineDrawing, CubeShowsNineEdgesAndHidesThree) {
  const LineDrawing drawing = to_scale("cube(size = [10, 20, 30]);", kIsometric);
  const auto outline = paths_of(drawing, LineKind::kSilhouette);
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_TRUE(outline[0].is_closed);
  EXPECT_EQ(outline[0].points.size(), 6u);
  for (const Vec2 corner : {isometric(0, 0, 0), isometric(10, 0, 0), isometric(10, 20, 0),
                            isometric(10, 20, 30), isometric(0, 20, 30), isometric(0, 0, 30)})
    EXPECT_TRUE(has_point(outline, corner)) << corner.x << " " << corner.y;
  const double unit = std::sqrt(2.0 / 3);  // of an axis
  EXPECT_NEAR(length_of(drawing, LineKind::kSilhouette), 120 * unit, 12 * kStep);
  const auto inner = paths_of(drawing, LineKind::kEdge);
  EXPECT_TRUE(has_point(inner, isometric(10, 0, 30)));
  EXPECT_NEAR(length_of(drawing, LineKind::kEdge), 60 * unit, 6 * kStep);
  const auto hidden = paths_of(drawing, LineKind::kHidden);
  EXPECT_TRUE(has_point(hidden, isometric(0, 20, 0)));
  EXPECT_NEAR(length_of(drawing, LineKind::kHidden), 60 * unit, 6 * kStep);
  // The sheet: the drawing and two millimetres around it.
  EXPECT_NEAR(drawing.size.x, 30 / std::sqrt(2.0) + 4, 2 * kStep);
  EXPECT_NEAR(drawing.corner.x, -2, kStep);
}

TEST(LineDrawing, LinesOnOneAnotherAreDrawnOnce) {
  // From the front, four edges lie before four others, and four are points.
  const LineDrawing drawing = to_scale("cube(size = [10, 20, 30]);", {90, 0, 0});
  ASSERT_EQ(drawing.paths.size(), 1u);
  EXPECT_TRUE(drawing.paths[0].is_closed);
  EXPECT_EQ(drawing.paths[0].points.size(), 4u);
  EXPECT_NEAR(length_of(drawing, LineKind::kSilhouette), 80, 4 * kStep);
}

TEST(LineDrawing, ScaleIsOfTheDrawing) {
  const Model model = model_of("cube(size = [10, 20, 30]);");
  const LineDrawing one = drawing_of(model, orthographic_camera({90, 0, 0}));
  const LineDrawing five = drawing_of(model, orthographic_camera({90, 0, 0}), {.scale = 5});
  EXPECT_NEAR(length_of(five, LineKind::kSilhouette), 5 * length_of(one, LineKind::kSilhouette),
              1e-9);
  EXPECT_NEAR(five.size.x - 4, 5 * (one.size.x - 4), 1e-9);
}

TEST(LineDrawing, BallIsACircle) {
  for (const double r : {2.0, 5.0, 8.5, 20.0, 33.0, 120.0}) {
    const LineDrawing drawing = to_scale("sphere(r = " + std::to_string(r) + ");", {63, 11, 40});
    ASSERT_EQ(drawing.paths.size(), 1u) << r;
    EXPECT_TRUE(drawing.paths[0].is_closed) << r;
    for (const Vec2 p : drawing.paths[0].points) {
      EXPECT_LT(length(p), r + kStep);
      EXPECT_GT(length(p), r - 2 * kFine);
    }
  }
}

TEST(LineDrawing, CylinderHasTwoSidesAndHidesHalfARim) {
  const double r = 10, h = 30, tilt = 60;  // degrees from straight down
  const LineDrawing drawing = to_scale("cylinder(h = 30, r1 = 10, r2 = 10);", {tilt, 0, 17});
  const auto outline = paths_of(drawing, LineKind::kSilhouette);
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_TRUE(outline[0].is_closed);
  // The rims are ellipses; of the upper one half is in the outline.
  const double flat = std::cos(tilt * std::numbers::pi / 180);
  const double half_rim = 2 * r * std::comp_ellint_2(std::sqrt(1 - flat * flat));
  const double side = h * std::sin(tilt * std::numbers::pi / 180);
  EXPECT_NEAR(length_of(drawing, LineKind::kSilhouette), 2 * side + 2 * half_rim, 0.1);
  EXPECT_NEAR(length_of(drawing, LineKind::kEdge), half_rim, 0.1);
  EXPECT_NEAR(length_of(drawing, LineKind::kHidden), half_rim, 0.1);
}

TEST(LineDrawing, OnlyFewSidesAreEdges) {
  // Six upright edges of a hexagon, none of a hundred sides.
  const Vec3 view{70, 0, 13};
  const auto uprights = [&](const char* sides) {
    const LineDrawing drawing =
        to_scale(std::string("cylinder(h = 30, r1 = 10, r2 = 10, $fn = ") + sides + ");", view);
    size_t count = 0;
    for (const DrawnPath& path : drawing.paths) {
      for (size_t i = 0; i + 1 < path.points.size(); ++i)
        count += std::fabs(path.points[i].y - path.points[i + 1].y) > 20;
      count += path.is_closed && std::fabs(path.points.front().y - path.points.back().y) > 20;
    }
    return count;
  };
  EXPECT_EQ(uprights("6"), 6u);
  EXPECT_EQ(uprights("12"), 12u);
  EXPECT_EQ(uprights("100"), 2u);
  EXPECT_EQ(uprights("0"), 2u);
}

TEST(LineDrawing, TangentSurfacesMeetWithoutALine) {
  // A round end: the wall goes over into the sides.
  const LineDrawing drawing = to_scale(
      "cube(size = [20, 10, 5]);"
      "multmatrix([[1,0,0,20],[0,1,0,5],[0,0,1,0],[0,0,0,1]]) cylinder(h = 5, r1 = 5, r2 = 5);",
      {0, 0, 0});
  ASSERT_EQ(drawing.paths.size(), 1u);
  EXPECT_TRUE(drawing.paths[0].is_closed);
  EXPECT_NEAR(length_of(drawing, LineKind::kSilhouette), 20 + 10 + 20 + 5 * std::numbers::pi, 0.05);
}

TEST(LineDrawing, FacetsThatDoNotFitAreNotSeen) {
  // A rod with a ball of its width at its end; a pin in a hole, turned; both lying aslant.
  const std::string aslant = "multmatrix([[1,0,0,0],[0,0.6,-0.8,0],[0,0.8,0.6,0],[0,0,0,1]]) ";
  const LineDrawing capsule =
      to_scale(aslant + "{ cylinder(h = 30, r1 = 5, r2 = 5); sphere(r = 5); }", {70, 0, 20}, false);
  const LineDrawing plain =
      to_scale(aslant + "cylinder(h = 30, r1 = 5, r2 = 5);", {70, 0, 20}, false);
  // One rim, at the other end.
  EXPECT_NEAR(length_of(capsule, LineKind::kEdge), length_of(plain, LineKind::kEdge), 0.1);
  const std::string block =
      "difference() { cube(size = [20, 20, 10], center = true);"
      "cylinder(h = 20, r1 = 5, r2 = 5, center = true); }";
  for (const char* turn : {"[0.8,-0.6,0,0],[0.6,0.8,0,0]", "[0,-1,0,0],[1,0,0,0]"}) {
    const LineDrawing pin = to_scale(block + "multmatrix([" + turn + ",[0,0,1,0],[0,0,0,1]])" +
                                         "cylinder(h = 10, r1 = 5, r2 = 5, center = true);",
                                     kIsometric, true);
    EXPECT_NEAR(length_of(pin, LineKind::kEdge), 50 * std::sqrt(2.0 / 3), 0.05) << turn;
    EXPECT_NEAR(length_of(pin, LineKind::kHidden), 50 * std::sqrt(2.0 / 3), 0.05) << turn;
  }
}

TEST(LineDrawing, TwistedSurfacesHaveNoWrinkles) {
  // Seen along a twisted surface every other triangle of it looks away. With those as contours the
  // drawing has 290 and more.
  const std::string twisted =
      "linear_extrude(height = 40, twist = 360, slices = 100) square(size = [30, 4], center = "
      "true);";
  for (const double turn : {0.0, 20.0}) {
    const LineDrawing drawing = to_scale(twisted, {40, 0, turn}, false);
    EXPECT_LT(length_of(drawing, LineKind::kSilhouette), 260) << turn;
    EXPECT_GT(length_of(drawing, LineKind::kSilhouette), 200) << turn;
  }
}

TEST(LineDrawing, BallsBesideOneAnotherHaveNoPoles) {
  // The topmost facets of all lie in one plane.
  const LineDrawing drawing = to_scale(
      "sphere(r = 10); multmatrix([[1,0,0,30],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) sphere(r = 10);",
      {40, 0, 0});
  EXPECT_EQ(drawing.paths.size(), 2u);
}

TEST(LineDrawing, SurfacesOfTwoBodiesMeetInACurve) {
  // A drill through a pipe: the curve where it enters is no plane's.
  const std::string drill =
      "multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0],[0,0,0,1]])"
      "cylinder(h = 30, r1 = 4, r2 = 4, center = true);";
  const LineDrawing drawing =
      to_scale("difference() { cylinder(h = 30, r1 = 10, r2 = 10, center = true); " + drill + "}",
               {90, 0, 0}, false);
  // Seen along the drill it is a circle, in the drawing once.
  double inner = 0;
  for (const DrawnPath& path : drawing.paths) {
    for (const Vec2 p : path.points) {
      if (length(p) > 9) continue;
      EXPECT_NEAR(length(p), 4, kFine + kStep);
    }
  }
  inner = length_of(drawing, LineKind::kSilhouette) + length_of(drawing, LineKind::kEdge) - 100;
  EXPECT_NEAR(inner, 8 * std::numbers::pi, 0.1);
}

TEST(LineDrawing, DrilledPlateShowsItsRims) {
  const std::string plate =
      "difference() { cube(size = [40, 40, 10], center = true);"
      "cylinder(h = 20, r1 = 8, r2 = 8, center = true); }";
  const LineDrawing above = to_scale(plate, {0, 0, 0});
  EXPECT_NEAR(length_of(above, LineKind::kSilhouette), 160 + 16 * std::numbers::pi, 0.1);
  EXPECT_EQ(length_of(above, LineKind::kHidden), 0);
  // From the side the hole is two dashed lines.
  const LineDrawing side = to_scale(plate, {90, 0, 0});
  EXPECT_NEAR(length_of(side, LineKind::kHidden), 20, 0.01);
  for (const DrawnPath& path : paths_of(side, LineKind::kHidden))
    for (const Vec2 p : path.points) EXPECT_NEAR(std::fabs(p.x), 8, kStep);
  // Aslant, a part of the lower rim is seen through the hole.
  const LineDrawing aslant = to_scale(plate, {35, 0, 0});
  const double flat = std::cos(35 * std::numbers::pi / 180);
  const double high = 10 * std::sin(35 * std::numbers::pi / 180);
  const double plate_lines = 3 * 40 + 2 * (40 * flat + high);
  // Both rims are ellipses; the lower one is moved by the plate's height as it is seen.
  const double most = std::acos(high / (8 * flat) / 2);
  double rims = 4 * 8 * std::comp_ellint_2(std::sqrt(1 - flat * flat));
  const int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const double angle = most * (2 * (i + 0.5) / steps - 1);
    rims += std::hypot(8 * std::cos(angle), 8 * flat * std::sin(angle)) * 2 * most / steps;
  }
  EXPECT_NEAR(length_of(aslant, LineKind::kSilhouette) + length_of(aslant, LineKind::kEdge),
              plate_lines + rims, 0.1);
}

TEST(LineDrawing, FlushBodiesAreOne) {
  const LineDrawing whole = to_scale("cube(size = [20, 20, 30]);", kIsometric);
  const LineDrawing halves = to_scale(
      "cube(size = [10, 20, 30]);"
      "multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size = [10, 20, 30]);",
      kIsometric);
  ASSERT_EQ(halves.paths.size(), whole.paths.size());
  for (const LineKind kind : {LineKind::kSilhouette, LineKind::kEdge, LineKind::kHidden})
    EXPECT_NEAR(length_of(halves, kind), length_of(whole, kind), 6 * kStep);
}

TEST(LineDrawing, BodiesThatTouchAreBothThere) {
  // In an edge and in a corner.
  for (const char* z : {"0", "10"}) {
    const LineDrawing drawing =
        to_scale("cube(size = 10); multmatrix([[1,0,0,10],[0,1,0,10],[0,0,1," + std::string(z) +
                     "],[0,0,0,1]]) cube(size = 10);",
                 {20, 0, 10}, false);
    EXPECT_GT(length_of(drawing, LineKind::kSilhouette) + length_of(drawing, LineKind::kEdge),
              4 * 2 * 9.0);
  }
}

TEST(LineDrawing, EyeInsideSeesTheInnerSide) {
  // In a box that is solid all the same.
  Camera camera = camera_of({0.5, 0.2, 0, 90, 0, 0, 0}, 100);
  camera.half_height = 2;
  const LineDrawing drawing = drawing_of(model_of("cube(size = 4, center = true);"), camera);
  // The wall before it, 1.8 away, and the edges that lead there, to the frame's sides.
  const double wall = 4 / 1.8 / 4 * 100;
  EXPECT_GT(length_of(drawing, LineKind::kEdge), 4 * wall);
  EXPECT_LT(length_of(drawing, LineKind::kEdge), 4 * wall + 4 * 40);
}

TEST(LineDrawing, WhatIsHiddenAndSeenIsAll) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Model model = model_of(random_tree(seed, {.coincident = seed % 2 == 0}));
    const Camera camera = orthographic_camera({50, 10, double(seed) * 31});
    const LineDrawing seen = drawing_of(model, camera);
    const LineDrawing all = drawing_of(model, camera, {.hidden = true}, 1);
    for (const LineKind kind : {LineKind::kSilhouette, LineKind::kEdge})
      EXPECT_NEAR(length_of(seen, kind), length_of(all, kind), 1e-9) << seed;
    EXPECT_EQ(length_of(seen, LineKind::kHidden), 0);
  }
}

TEST(LineDrawing, ThreadsChangeNothing) {
  const Model model = model_of(random_tree(3, {.primitives = 40}));
  const Camera camera = orthographic_camera({50, 10, 20});
  const LineDrawing one = drawing_of(model, camera, {.hidden = true}, 1);
  const LineDrawing five = drawing_of(model, camera, {.hidden = true}, 5);
  ASSERT_EQ(one.paths.size(), five.paths.size());
  for (size_t i = 0; i < one.paths.size(); ++i) {
    EXPECT_EQ(one.paths[i].kind, five.paths[i].kind);
    EXPECT_EQ(one.paths[i].points, five.paths[i].points);
  }
}

TEST(LineDrawing, SaysWhatCannotBeDrawn) {
  const auto error = [](const std::string& text, const LineSettings& settings) {
    const Result<LineDrawing> drawing =
        draw_lines(model_of(text), orthographic_camera({50, 0, 20}), settings, 1);
    EXPECT_FALSE(drawing);
    return drawing ? Error{} : drawing.error();
  };
  const Error many = error("sphere(r = 20);", {.most_facets = 10});
  EXPECT_EQ(many.kind, ErrorKind::kMachine);
  EXPECT_EQ(many.message, "test.csg: error: a line drawing of more than 10 facets is too large");
  // Coordinates are written in steps of a thousandth.
  const Error large = error("cube(1e14);", {});
  EXPECT_EQ(large.kind, ErrorKind::kInput);
  EXPECT_EQ(large.message,
            "test.csg: error: the solid is too large for a line drawing of this scale");
  EXPECT_EQ(error("cube(1e9);", {.scale = 1e8}).kind, ErrorKind::kInput);
  EXPECT_EQ(error("halfspace(n = [0, 0, 1], d = 0);", {}).kind, ErrorKind::kInput);
  EXPECT_TRUE(drawing_of(model_of("group();"), orthographic_camera({50, 0, 20})).paths.empty());
}

}  // namespace
}  // namespace whittle

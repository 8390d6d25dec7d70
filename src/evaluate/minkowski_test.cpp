#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "evaluate/convex_hull.h"
#include "evaluate/convex_pieces.h"
#include "evaluate/evaluate_test_support.h"
#include "evaluate/minkowski.h"

namespace whittle {
namespace {

/// A box of the grid, as text.
struct GridBox {
  Vec3 lo, hi;

  std::string text() const {
    const Vec3 size = hi - lo;
    return "translate([" + std::to_string(int(lo.x)) + "," + std::to_string(int(lo.y)) + "," +
           std::to_string(int(lo.z)) + "]) cube([" + std::to_string(int(size.x)) + "," +
           std::to_string(int(size.y)) + "," + std::to_string(int(size.z)) + "]);";
  }
  bool holds(Vec3 p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < lo[axis] || p[axis] > hi[axis]) return false;
    return true;
  }
};

/// Boxes minus boxes on a grid: the cells that are in it are known.
class GridSolid {
 public:
  static constexpr int kSide = 5;

  explicit GridSolid(std::mt19937& random) {
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    const auto box = [&] {
      GridBox made;
      for (int axis = 0; axis < 3; ++axis) {
        made.lo[axis] = below(kSide);
        made.hi[axis] = made.lo[axis] + 1 + below(kSide - int(made.lo[axis]));
      }
      return made;
    };
    std::string first, others;
    std::vector<GridBox> in, out;
    for (int k = 1 + below(2); k > 0; --k) first += in.emplace_back(box()).text();
    for (int k = 1 + below(3); k > 0; --k) others += out.emplace_back(box()).text();
    text_ = "difference() { union() { " + first + " } " + others + " }";
    for (int x = 0; x < kSide; ++x) {
      for (int y = 0; y < kSide; ++y) {
        for (int z = 0; z < kSide; ++z) {
          const Vec3 middle{x + 0.5, y + 0.5, z + 0.5};
          const auto holds = [&](const GridBox& b) { return b.holds(middle); };
          if (std::any_of(in.begin(), in.end(), holds) &&
              std::none_of(out.begin(), out.end(), holds))
            cells_.push_back({double(x), double(y), double(z)});
        }
      }
    }
  }

  const std::string& text() const { return text_; }
  const std::vector<Vec3>& cells() const { return cells_; }

 private:
  std::string text_;
  std::vector<Vec3> cells_;
};

/// Sums of unit cubes are cubes of two.
bool is_in_sum(const GridSolid& a, const GridSolid& b, Vec3 p) {
  for (const Vec3 s : a.cells())
    for (const Vec3 t : b.cells())
      if (GridBox{s + t, s + t + Vec3{2, 2, 2}}.holds(p)) return true;
  return false;
}

TEST(Minkowski, OfConvexSolidsIsTheirSum) {
  expect_same("minkowski() { cube(3); translate([1, 0, 0]) cube([1, 2, 3]); }",
              "translate([1, 0, 0]) cube([4, 5, 6]);");
  expect_same("minkowski() { cube(3); cube(1); cube(2); }", "cube(6);");
  expect_same("minkowski() cube(3);", "cube(3);");
  expect_same("minkowski() { cube(3); group(); cube(0); }", "cube(3);");
  expect_empty("minkowski();");
  EXPECT_EQ(evaluated("cube(); minkowski() { cube(3); cube(1); }").model.primitives[1].id, 2u);
}

TEST(Minkowski, OfUnionsIsTheUnionOfSums) {
  const std::string l = "{ cube([6, 1, 1]); cube([1, 6, 1]); }";
  expect_same("minkowski() { union() " + l + " cube(1); }", "cube([7, 2, 2]); cube([2, 7, 2]);");
  expect_same(
      "minkowski() { linear_extrude(1) polygon([[0,0],[6,0],[6,1],[1,1],[1,6],[0,6]]); "
      "cube(1); }",
      "cube([7, 2, 2]); cube([2, 7, 2]);");
  const Model model = evaluated("cube(); minkowski() { union() " + l + " cube(1); }").model;
  EXPECT_EQ(lone_primitive(evaluated("minkowski() { union() " + l + " cube(1); }").model), 1u);
  for (size_t i = 1; i < model.primitives.size(); ++i) EXPECT_EQ(model.primitives[i].id, 2u);
}

TEST(Minkowski, OfWhatIsCutWithWhatIsConvex) {
  const std::string l = "difference() { cube(6); translate([2, 2, -1]) cube(9); }";
  expect_same("minkowski() { " + l + " cube(1); }",
              "difference() { cube(7); translate([3, 3, -1]) cube(9); }");
  expect_same("minkowski() { cube(1); " + l + " }",
              "difference() { cube(7); translate([3, 3, -1]) cube(9); }");
  expect_same("minkowski() { cube(1); " + l + " cube(1); }",
              "difference() { cube(8); translate([4, 4, -1]) cube(9); }");
  // What is convex after all is one part.
  const Model corner =
      evaluated(
          "minkowski() { difference() { cube(6); translate([2, -1, -1]) cube(9); } cube(1); }")
          .model;
  ASSERT_EQ(corner.primitives.size(), 1u);
  EXPECT_EQ(bounds(corner).box, (Box{{0, 0, 0}, {3, 7, 7}}));
}

TEST(Minkowski, HolesAndHollowsShrinkAndClose) {
  const auto box_with = [](const char* hole) {
    return std::string("difference() { cube(10, center = true); cube(") + hole +
           ", center = true); }";
  };
  const std::string cube = " cube(2, center = true); }";
  expect_same("minkowski() { " + box_with("[4, 4, 20]") + cube,
              "difference() { cube(12, center = true); cube([2, 2, 20], center = true); }");
  expect_same("minkowski() { " + box_with("[2, 2, 20]") + cube, "cube(12, center = true);");
  expect_same("minkowski() { " + box_with("4") + cube,
              "difference() { cube(12, center = true); cube(2, center = true); }");
  expect_same("minkowski() { " + box_with("1") + cube, "cube(12, center = true);");
  // Erosion: what is left is where the tool does not reach into what was cut away.
  expect_same(
      "difference() { cube(10, center = true); minkowski() { difference() { cube(30, center = "
      "true);"
      " cube(10, center = true); } cube(2, center = true); } }",
      "cube(8, center = true);");
}

TEST(Minkowski, OfWhatIsCutWithWhatIsCut) {
  expect_same(
      "minkowski() { difference() { cube(10, center = true); cube([4, 4, 20], center = true); } "
      "difference() { cube([9, 1, 1]); translate([1, -1, -1]) cube([7, 9, 9]); } }",
      "difference() { translate([-5, -5, -5]) cube([11, 11, 11]); translate([-1, -1, "
      "-9]) cube([3, 3, 30]); } difference() { translate([3, -5, -5]) cube([11, 11, 11]); "
      "translate([7, -1, -9]) cube([3, 3, 30]); }");
}

TEST(Minkowski, IsItsDefinitionOnAGrid) {
  std::mt19937 random(1);
  int compared = 0;
  for (int round = 0; round < 60; ++round) {
    const GridSolid a(random), b(random);
    if (a.cells().empty() || b.cells().empty()) continue;
    const Read read = evaluated("minkowski() { " + a.text() + b.text() + " }");
    EXPECT_FALSE(read.unsupported);
    const Inside inside(read.model);
    for (int x = 0; x < 10; ++x)
      for (int y = 0; y < 10; ++y)
        for (int z = 0; z < 10; ++z, ++compared) {
          const Vec3 p{x + 0.4375, y + 0.53125, z + 0.46875};
          ASSERT_EQ(inside(p), is_in_sum(a, b, p))
              << p.x << " " << p.y << " " << p.z << " in the sum of\n"
              << a.text() << "\n"
              << b.text();
        }
  }
  EXPECT_GT(compared, 30000);
}

/// A ball of facets is held by one of radius 1 and holds one of 0.97. Points of the body, a quarter
/// apart, say how near it is.
TEST(Minkowski, WithABallIsWhatIsNear) {
  const std::string text =
      "difference() { rotate([20, 30, 10]) cube([9, 7, 5]); translate([4, 4, 1]) rotate([0, 50, "
      "0]) "
      "cylinder(h = 40, r = 2, center = true, $fn = 7); }";
  const Read body = evaluated(text);
  const Read sum = evaluated("minkowski() { " + text + " sphere(1, $fn = 24); }");
  const Inside in_body(body.model), in_sum(sum.model);
  Points anywhere(bounds(body.model).box);
  std::vector<Vec3> of_body;
  while (of_body.size() < 20000) {
    const Vec3 p = anywhere.next();
    if (in_body(p)) of_body.push_back(p);
  }
  Points points(bounds(sum.model).box);
  int near = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 p = points.next();
    double distance = kInfinity;
    for (const Vec3 q : of_body) distance = std::fmin(distance, length(p - q));
    near += distance <= 0.97;
    if (distance <= 0.97) {
      EXPECT_TRUE(in_sum(p)) << p.x << " " << p.y << " " << p.z;
    }
    if (in_sum(p)) {
      EXPECT_LE(distance, 1.5) << p.x << " " << p.y << " " << p.z;
    }
  }
  EXPECT_GT(near, 200);
}

/// The sum of convex bodies reaches as far in each direction as both together.
RC_GTEST_PROP(Minkowski, OfConvexBodiesReachesAsFarAsBoth, ()) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const auto body = [&] {
    SolidPart part;
    const int n = 4 + int(random() % 30);
    const int extent = random() % 2 == 0 ? 3 : 1000;
    for (int i = 0; i < n; ++i) {
      const auto x = [&] { return double(int(random() % unsigned(2 * extent + 1)) - extent); };
      part.points.push_back({x(), x(), x()});
    }
    return part;
  };
  SolidPart a = body(), b = body();
  b.operand = 1;
  RC_PRE(solid_hull(a.points) && solid_hull(b.points));
  Budget budget(1'000'000);
  const std::vector<Shape> sum = minkowski_sum({a, b}, 1, budget);
  RC_ASSERT(sum.size() == 1u);
  const auto& solid = std::get<Polyhedron>(sum[0]);
  const auto reach = [](const std::vector<Vec3>& points, Vec3 d) {
    double most = -kInfinity;
    for (const Vec3 p : points) most = std::fmax(most, dot(p, d));
    return most;
  };
  for (int i = 0; i < 200; ++i) {
    const auto x = [&] { return double(random() % 2001) - 1000; };
    const Vec3 d = normalize(Vec3{x(), x(), x()});
    RC_ASSERT(std::fabs(reach(solid.points, d) - reach(a.points, d) - reach(b.points, d)) < 1e-6);
  }
}

TEST(Minkowski, HasALimit) {
  ReadOptions options = with_boundaries();
  options.limits.facets = 20000;
  const std::string text =
      "cube();\n minkowski() { difference() { sphere(9, $fn = 30); sphere(8, $fn = 30); } "
      "difference() { sphere(2, $fn = 20); cube(2); } }";
  const std::string error = evaluation_error(text, options);
  EXPECT_EQ(error.find("t.csg:2:2: error: "), 0u) << error;
  EXPECT_NE(error.find("sums"), std::string::npos) << error;
}

TEST(ConvexPieces, AreFewConvexAndAll) {
  // A square ring of eight triangles around a hole.
  const std::vector<Vec3> points = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0},
                                    {3, 3, 0}, {6, 3, 0}, {6, 6, 0}, {3, 6, 0}};
  std::vector<TriangleMesh::Triangle> ring;
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t next = (k + 1) % 4;
    ring.push_back({{k, next, 4 + next}, 0});
    ring.push_back({{k, 4 + next, 4 + k}, 0});
  }
  const std::vector<std::vector<uint32_t>> pieces = convex_pieces(points, ring);
  EXPECT_EQ(pieces.size(), 4u);
  double area = 0;
  for (const std::vector<uint32_t>& piece : pieces) {
    EXPECT_EQ(piece.size(), 4u);
    for (size_t k = 2; k < piece.size(); ++k) {
      const Vec3 o = points[piece[0]];
      const double twice = cross(points[piece[k - 1]] - o, points[piece[k]] - o).z;
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
  }
  EXPECT_DOUBLE_EQ(area, 81 - 9);
  // Of two facets, nothing is joined.
  for (size_t k = 0; k < ring.size(); ++k) ring[k].facet = uint32_t(k);
  EXPECT_EQ(convex_pieces(points, ring).size(), 8u);
}

}  // namespace
}  // namespace whittle

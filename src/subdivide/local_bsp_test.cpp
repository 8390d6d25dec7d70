// What a leaf says of a boundary, against the winding number of all its triangles.
#include "subdivide/local_bsp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>

#include "base/result.h"
#include "lower/evaluate.h"
#include "lower/lower.h"
#include "subdivide/simplify.h"
#include "support/meshes.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Coordinates as six digits give them.
TriangleMesh printed(const TriangleMesh& mesh) {
  return changed(mesh, [](double x) { return std::round(x * 1e5) / 1e5; });
}

/// Corners in the middle, in the middle of halves and so on: where cells are cut.
TriangleMesh on_cuts(const TriangleMesh& mesh) {
  return changed(mesh, [](double x) { return std::round(x * 4) / 4; });
}

std::vector<TriangleMesh> meshes() {
  const TriangleMesh ball = bumpy_mesh(2, 0.1, 4, 7);
  return {
      box_mesh({{-2, -2, -2}, {2, 2, 2}}, 4),
      star_mesh(7, 0.5, 2, 1),
      torus_mesh(2, 0.75, 16, 8),
      ball,
      printed(ball),
      printed(torus_mesh(1.9, 0.7, 40, 20)),
      on_cuts(bumpy_mesh(3, 0.2, 3, 3)),
      together({ball, box_mesh({{-1, -1, -1}, {3, 3, 3}}, 2)}),
      together({ball, inside_out(box_mesh({{-1, -1, -1}, {0.5, 0.5, 0.5}}, 1))}),
      inside_out(torus_mesh(2, 0.5, 9, 7)),
  };
}

/// The distance from the nearest plane of a triangle that comes as near as that.
bool is_near_surface(const Scene& scene, Vec3 p, double distance) {
  bool near = false;
  scene.boundaries[0].visit_in(p, {distance, distance, distance}, [&](uint32_t) {
    near = true;
    return false;
  });
  return near;
}

/// Asks of points of a cell, no nearer to the surface than `tell`, whether what the cell says of
/// them is what the winding number says. The number of points.
int agreeing_points(const Scene& scene, const Box& cell, Truth truth, const Formula& formula,
                    double tell, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  int asked = 0;
  for (int k = 0; k < 20; ++k) {
    Vec3 p = cell.lo;
    for (int axis = 0; axis < 3; ++axis) p[axis] += share(random) * cell.size()[axis];
    if (is_near_surface(scene, p, tell)) continue;
    const bool inside =
        truth == Truth::kVaries ? contains(scene, formula, p) : truth == Truth::kTrue;
    ++asked;
    EXPECT_EQ(inside, scene.boundaries[0].winding(p) != 0)
        << "at " << p.x << ' ' << p.y << ' ' << p.z;
  }
  return asked;
}

class LocalBspOf : public testing::TestWithParam<size_t> {};

TEST_P(LocalBspOf, RandomCellsSaysWhatTheWindingNumberSays) {
  const Model model = with_meshes("cube(1);", {meshes()[GetParam()]});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->boundaries.size(), 1u);
  const UnitBoxes boxes(*scene);
  Simplifier simplifier(*scene, boxes, 1e-10 * max_component(scene->region.size()));
  const double tell = 20 * scene->boundaries[0].slack();
  LocalBsp bsp(*scene);
  std::mt19937 random(uint32_t(GetParam()) + 1);
  std::uniform_real_distribution<double> share(0, 1);
  Formula formula;
  int asked = 0, varied = 0;
  for (int i = 0; i < 3000; ++i) {
    // Half of them are cells as halving makes them.
    Box cell = scene->region;
    const int splits = 1 + int(share(random) * 14);
    for (int k = 0; k < splits; ++k) {
      const double cut = i % 2 ? 0.5 : 0.3 + 0.4 * share(random);
      const double at = cell.lo[k % 3] + cut * cell.size()[k % 3];
      (share(random) < 0.5 ? cell.lo : cell.hi)[k % 3] = at;
    }
    // A formula of a crowd takes long.
    if (i % 128 != 0 && bsp.count(scene->units[0], CellBox(cell, 0)) == LocalBsp::kTooMany)
      continue;
    const Truth truth = simplifier.simplify(scene->formula, cell, Expand::kAll, formula);
    varied += truth == Truth::kVaries;
    for (const Token token : formula) EXPECT_NE(token.kind(), TokenKind::kUnit);
    asked += agreeing_points(*scene, cell, truth, formula, tell, random);
    ASSERT_FALSE(HasFailure()) << "cell " << i;
  }
  EXPECT_GT(asked, 20000);
  EXPECT_GT(varied, 50);
}

INSTANTIATE_TEST_SUITE_P(All, LocalBspOf, testing::Range<size_t>(0, 10));

TEST_P(LocalBspOf, APartOfACellIsTheSameByTheTrianglesNearTheCell) {
  const Model model = with_meshes("cube(1); cube(2);", {meshes()[GetParam()], meshes()[0]});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  const UnitBoxes boxes(*scene);
  Simplifier simplifier(*scene, boxes, 1e-10 * max_component(scene->region.size()));
  std::mt19937 random(uint32_t(GetParam()) + 1);
  std::vector<uint32_t> near, near_part, expected_near;
  Formula whole, part, expected;
  int listed = 0;
  for (int i = 0; i < 60; ++i) {
    Box cell = scene->region;
    simplifier.simplify(scene->formula, cell, Expand::kUnits, whole);
    simplifier.list_near(whole, near);
    for (int k = 0; k < 12 && !whole.empty(); ++k) {
      (random() % 2 ? cell.lo : cell.hi)[k % 3] = cell.center()[k % 3];
      for (const Expand expand : {Expand::kAll, Expand::kUnits}) {
        // A formula of a crowd takes long.
        if (expand == Expand::kAll && k < 6) continue;
        const Truth truth = simplifier.simplify(whole, cell, expand, part, near);
        simplifier.list_near(part, near_part);
        ASSERT_EQ(simplifier.simplify(whole, cell, expand, expected), truth);
        simplifier.list_near(expected, expected_near);
        // In any order the triangles are the same; a crowd may be cut short at others.
        if (expand == Expand::kUnits) {
          ASSERT_EQ(part, expected);
        }
        ASSERT_EQ(part.size(), expected.size());
        std::ranges::sort(expected_near);
        std::vector<uint32_t> sorted = near_part;
        std::ranges::sort(sorted);
        ASSERT_EQ(sorted, expected_near);
        listed += near_part.size() > 4;
      }
      std::swap(whole, part);
      std::swap(near, near_part);
    }
  }
  EXPECT_GT(listed, 100);
}

TEST_P(LocalBspOf, APartOfACellIsTheSameByWhatTheCellSays) {
  const Model model = with_meshes("cube(1);", {meshes()[GetParam()]});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  const UnitBoxes boxes(*scene);
  Simplifier simplifier(*scene, boxes, 1e-12 * max_component(scene->region.size()));
  const double tell = 20 * scene->boundaries[0].slack();
  std::mt19937 random(uint32_t(GetParam()) + 1);
  std::uniform_real_distribution<double> share(0, 1);
  Formula whole, part;
  int asked = 0;
  for (int i = 0; i < 1000; ++i) {
    Box cell = scene->region;
    const int splits = 5 + int(share(random) * 6);
    for (int k = 0; k < splits; ++k)
      (random() % 2 ? cell.lo : cell.hi)[k % 3] = cell.center()[k % 3];
    if (simplifier.simplify(scene->formula, cell, Expand::kAll, whole) != Truth::kVaries) continue;
    for (int k = splits; k < splits + 2; ++k)
      (random() % 2 ? cell.lo : cell.hi)[k % 3] = cell.center()[k % 3];
    const Truth truth = simplifier.simplify(whole, cell, Expand::kAll, part);
    asked += agreeing_points(*scene, cell, truth, part, tell, random);
    ASSERT_FALSE(HasFailure()) << "cell " << i;
  }
  EXPECT_GT(asked, 1000);
}

// A corner lies on a cell's side: what is beyond reaches the cell with its rim alone.
TEST(LocalBsp, NeighboursAcrossACornerOnACutAgree) {
  const Model model = with_meshes("cube(1);", {on_cuts(bumpy_mesh(3, 0.2, 3, 3))});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  const UnitBoxes boxes(*scene);
  Simplifier simplifier(*scene, boxes, 1e-10 * max_component(scene->region.size()));
  const Boundary& boundary = scene->boundaries[0];
  Formula formula;
  for (const Boundary::Triangle& triangle : boundary.triangles())
    for (const uint32_t corner : triangle.corners) {
      const Vec3 p = boundary.point(corner);
      for (int i = 0; i < 8; ++i) {
        const Vec3 q = p + Vec3{i & 1 ? 0.4 : -0.4, i & 2 ? 0.4 : -0.4, i & 4 ? 0.4 : -0.4};
        const Box cell{min(p, q), max(p, q)};
        const Truth truth = simplifier.simplify(scene->formula, cell, Expand::kAll, formula);
        const Vec3 middle = p + (q - p) * 0.37;
        if (is_near_surface(*scene, middle, 1e-6)) continue;
        const bool inside =
            truth == Truth::kVaries ? contains(*scene, formula, middle) : truth == Truth::kTrue;
        EXPECT_EQ(inside, boundary.winding(middle) != 0);
      }
    }
}

// A point from which a part is known must not lie in what is beyond the cell: in the box, here.
TEST(LocalBsp, AnotherShellBesideTheCellSaysNothing) {
  TriangleMesh pyramid;
  pyramid.points = {{1, 0.5, -1}, {2, 0.5, -1}, {2, 1.5, -1}, {1, 1.5, -1}, {1.5, 1, 1}};
  for (const std::array<uint32_t, 3>& corners : std::initializer_list<std::array<uint32_t, 3>>{
           {0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})
    pyramid.triangles.push_back({corners, 0});
  pyramid = changed(pyramid, [](double x) { return x; });
  const Model model = with_meshes(
      "cube(1);", {together({box_mesh({{-2, -1.5, -1.5}, {1, 1.5, 1.5}}, 1), pyramid})});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  LocalBsp bsp(*scene);
  const CellBox cell({{1.00001, 0, -1.5}, {2, 1.5, 0}}, 1e-10);
  const std::span<const Token> tokens = bsp.formula(scene->units[0], cell, false);
  const Formula formula(tokens.begin(), tokens.end());
  EXPECT_FALSE(contains(*scene, formula, {1.1, 0.1, -0.5}));
  EXPECT_TRUE(contains(*scene, formula, {1.5, 1, -0.5}));
}

// What touches itself along a line, twisted and far away: beside the line, planes of triangles that
// hardly reach a cell cut parts off it that hold none of the points that are tried first.
TEST(LocalBsp, PartsBesideATwistedLineOfContact) {
  const Model model = model_of(
      "translate([1e6, 0, -1e6]) linear_extrude(4, center = true, twist = 90, slices = 2)"
      " polygon([[1, 0], [2, 1], [3, 0], [3, 2], [2, 1], [1, 2]]);");
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  const UnitBoxes boxes(*scene);
  Simplifier simplifier(*scene, boxes, 1e-10 * max_component(scene->region.size()));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  Formula formula;
  int asked = 0;
  for (int i = 0; i < 2000; ++i) {
    Box cell = scene->region;
    const int splits = 1 + int(share(random) * 12);
    for (int k = 0; k < splits; ++k)
      (share(random) < 0.5 ? cell.lo : cell.hi)[k % 3] = cell.center()[k % 3];
    const Truth truth = simplifier.simplify(scene->formula, cell, Expand::kAll, formula);
    asked += agreeing_points(*scene, cell, truth, formula, 1e-7, random);
    ASSERT_FALSE(HasFailure()) << "cell " << i;
  }
  EXPECT_GT(asked, 30000);
}

TEST(LocalBsp, AnEdgeIsTwoLiterals) {
  const Model model = with_meshes("cube(1);", {box_mesh({{-2, -2, -2}, {2, 2, 2}}, 3)});
  const Result<Scene> scene = lower(model);
  ASSERT_TRUE(scene);
  LocalBsp bsp(*scene);
  const Unit& unit = scene->units[0];
  const CellBox edge({{1.9, 1.9, -0.1}, {2.1, 2.1, 0.2}}, 0);
  EXPECT_EQ(bsp.count(unit, edge), 2u);
  EXPECT_EQ(bsp.formula(unit, edge, false).size(), 3u);
  EXPECT_EQ(bsp.formula(unit, edge, false)[0].kind(), TokenKind::kAnd);
  EXPECT_EQ(bsp.formula(unit, edge, true)[0].kind(), TokenKind::kOr);
  EXPECT_EQ(bsp.operands(), 2u);
  const CellBox inside({{-1, -1, -1}, {1, 1, 1}}, 0);
  EXPECT_EQ(bsp.count(unit, inside), 0u);
  EXPECT_TRUE(bsp.is_inside(unit, inside));
  EXPECT_EQ(bsp.count(unit, CellBox(scene->region, 0)), LocalBsp::kTooMany);
}

}  // namespace
}  // namespace whittle

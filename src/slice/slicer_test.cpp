#include "slice/slicer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "boundary/evaluate_solid.h"
#include "lower/lower.h"
#include "support/mesh_checks.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

SolidMesh mesh_of_text(std::string_view text) {
  const Workers workers(2);
  const Result<Scene> scene = lower(facetted_model_of(text), &workers);
  WHITTLE_CHECK(scene);
  Result<SolidMesh> mesh = evaluate_solid(*scene, workers);
  if (!mesh) ADD_FAILURE() << mesh.error().message;
  return mesh ? *std::move(mesh) : SolidMesh{};
}

double area(const Contour& loop) {
  double twice = 0;
  for (size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  return twice / 2;
}

double area(const std::vector<Contour>& loops) {
  double sum = 0;
  for (const Contour& loop : loops) sum += area(loop);
  return sum;
}

/// How often loops wind around a point, by the sides that a ray to the right crosses.
int winding(const std::vector<Contour>& loops, Vec2 p) {
  int sum = 0;
  for (const Contour& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a.y <= p.y && b.y > p.y && cross(b - a, p - a) > 0) ++sum;
      if (a.y > p.y && b.y <= p.y && cross(b - a, p - a) < 0) --sum;
    }
  }
  return sum;
}

constexpr const char* kDrilled =
    "difference() { cube(size = [20, 10, 4]);"
    " multmatrix([[1, 0, 0, 6], [0, 1, 0, 5], [0, 0, 1, 1], [0, 0, 0, 1]])"
    " cylinder(h = 9, r = 2, $fn = 12); }";
/// Of a regular polygon with twelve corners at distance 2.
const double kTwelveCorners = 6 * 4 * std::sin(std::numbers::pi / 6);

TEST(Slicer, ACubeIsASquareOfFourCorners) {
  const SolidMesh mesh = mesh_of_text("cube(size = [2, 3, 4]);");
  const Slicer slicer(mesh);
  for (const double z : {0.0, 0.1, 2.0, 3.9}) {
    const std::vector<Contour> loops = slicer.at(z);
    ASSERT_EQ(loops.size(), 1u) << z;
    EXPECT_EQ(loops[0].size(), 4u) << z;
    EXPECT_DOUBLE_EQ(area(loops), 6) << z;
    for (const Vec2 corner : {Vec2{0, 0}, Vec2{2, 0}, Vec2{2, 3}, Vec2{0, 3}})
      EXPECT_EQ(std::ranges::count(loops[0], corner), 1) << z;
  }
}

/// What begins in the plane belongs to the layer, what ends there does not.
TEST(Slicer, TakesTheMaterialJustAbove) {
  const SolidMesh mesh = mesh_of_text(kDrilled);
  const Slicer slicer(mesh);
  EXPECT_TRUE(slicer.at(-1e-9).empty());
  EXPECT_DOUBLE_EQ(area(slicer.at(0)), 200);
  EXPECT_DOUBLE_EQ(area(slicer.at(1 - 1e-9)), 200);
  EXPECT_DOUBLE_EQ(area(slicer.at(1)), 200 - kTwelveCorners);
  EXPECT_DOUBLE_EQ(area(slicer.at(4 - 1e-9)), 200 - kTwelveCorners);
  EXPECT_TRUE(slicer.at(4).empty());
  EXPECT_TRUE(slicer.at(1e300).empty());
  EXPECT_TRUE(slicer.at(-1e300).empty());
}

TEST(Slicer, HolesRunClockwise) {
  const SolidMesh mesh = mesh_of_text(kDrilled);
  std::vector<Contour> loops = Slicer(mesh).at(2);
  ASSERT_EQ(loops.size(), 2u);
  std::ranges::sort(loops, {}, &Contour::size);
  EXPECT_EQ(loops[0].size(), 4u);
  EXPECT_DOUBLE_EQ(area(loops[0]), 200);
  EXPECT_EQ(loops[1].size(), 12u);
  EXPECT_DOUBLE_EQ(area(loops[1]), -kTwelveCorners);
}

TEST(Slicer, OfAConeFallsWithTheSquareOfTheHeight) {
  const SolidMesh mesh = mesh_of_text("cylinder(h = 10, r1 = 2, r2 = 0, $fn = 12);");
  const Slicer slicer(mesh);
  for (const double z : {0.0, 1.0, 5.0, 9.0, 9.999}) {
    const double share = 1 - z / 10;
    EXPECT_NEAR(area(slicer.at(z)), kTwelveCorners * share * share, 1e-13) << z;
    EXPECT_EQ(slicer.at(z).at(0).size(), 12u) << z;
  }
}

/// Rings of OpenSCAD's spheres are at the middles of their latitudes, with straight sides between.
TEST(Slicer, OfASphereLiesBetweenTwoRings) {
  constexpr int kRings = 10, kSides = 20;
  const SolidMesh mesh = mesh_of_text("sphere(r = 5, $fn = 20);");
  const Slicer slicer(mesh);
  const auto ring = [](int i) {
    const double angle = std::numbers::pi * (i + 0.5) / kRings;
    return Vec2{5 * std::sin(angle), 5 * std::cos(angle)};
  };
  for (int i = 0; i + 1 < kRings; ++i) {
    const Vec2 above = ring(i), below = ring(i + 1);
    const double r = (above.x + below.x) / 2, z = (above.y + below.y) / 2;
    EXPECT_NEAR(area(slicer.at(z)), kSides / 2.0 * r * r * std::sin(2 * std::numbers::pi / kSides),
                1e-12)
        << z;
    EXPECT_EQ(slicer.at(z).at(0).size(), size_t(kSides)) << z;
  }
}

/// A cone's lowest corner, and a roof's lowest edge, have nothing above them yet.
TEST(Slicer, AnEdgeOrCornerInThePlaneIsNoLoop) {
  const SolidMesh cones = mesh_of_text(
      "cylinder(h = 2, r1 = 0, r2 = 1, $fn = 4);"
      "multmatrix([[0, 0, 1, 5], [0.7071, 0.7071, 0, 0], [-0.7071, 0.7071, 0, 0], [0, 0, 0, 1]])"
      "cube(size = [1, 1, 3]);");
  double lowest = 0;
  for (const Vec3& corner : cones.corners) lowest = std::min(lowest, corner.z);
  EXPECT_LT(lowest, 0);
  const Slicer slicer(cones);
  EXPECT_TRUE(slicer.at(lowest).empty());
  const std::vector<Contour> loops = slicer.at(0);
  ASSERT_EQ(loops.size(), 1u) << "the cone's tip is no loop";
  EXPECT_EQ(loops[0].size(), 4u);
}

/// A keel under a block's side wall, whose edge is where the block's section is taken.
TEST(Slicer, LeavesOutWaysThereAndBack) {
  const SolidMesh mesh = mesh_of_text(
      "union() { cube(size = [4, 4, 4]);"
      " polyhedron(points = [[3, 2, 2], [9, 2, 2], [3, 1, 3], [9, 1, 3], [3, 3, 3], [9, 3, 3]],"
      " faces = [[0, 2, 4], [1, 5, 3], [0, 1, 3, 2], [0, 4, 5, 1], [2, 3, 5, 4]]); }");
  ASSERT_EQ(manifold_fault(mesh), "");
  EXPECT_DOUBLE_EQ(area(Slicer(mesh).at(2.5)), 16 + 5 * 1);
  // Loops begin where corners have the least numbers, so each place is the first one once.
  const auto n = uint32_t(mesh.corners.size());
  for (uint32_t shift = 0; shift < n; ++shift) {
    SolidMesh other = mesh;
    for (uint32_t i = 0; i < n; ++i) other.corners[(i + shift) % n] = mesh.corners[i];
    for (SolidMesh::Triangle& triangle : other.triangles)
      for (uint32_t& corner : triangle.corners) corner = (corner + shift) % n;
    const std::vector<Contour> loops = Slicer(other).at(2);
    ASSERT_EQ(loops.size(), 1u);
    for (const Vec2& corner : loops[0]) EXPECT_LE(corner.x, 4) << "there is nothing out there";
    EXPECT_DOUBLE_EQ(area(loops), 16);
  }
}

TEST(Slicer, SidesOfDifferentFacesStayApart) {
  SolidMesh mesh = mesh_of_text("cube(size = [2, 3, 4]);");
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.triangles[i].face = i;
  EXPECT_EQ(Slicer(mesh).at(1).at(0).size(), 8u);
}

/// What touches along an upright edge stays in two loops, and the sum of both is right.
TEST(Slicer, OfTwoCubesThatTouchInAnEdge) {
  const SolidMesh mesh = mesh_of_text(
      "cube(size = 1); multmatrix([[1,0,0,1],[0,1,0,1],[0,0,1,0],[0,0,0,1]]) cube(size = 1);");
  const std::vector<Contour> loops = Slicer(mesh).at(0.5);
  EXPECT_EQ(loops.size(), 2u);
  EXPECT_DOUBLE_EQ(area(loops), 2);
}

/// Corners that were turned are off by rounding, and yet a layer at the bottom is whole.
TEST(Slicer, RoundingDoesNotEmptyALayer) {
  const SolidMesh mesh = mesh_of_text(
      "multmatrix([[0.36, 0.48, -0.8, 0], [-0.8, 0.6, 0, 0], [0.48, 0.64, 0.6, 0], [0, 0, 0, 1]])"
      "multmatrix([[0.36, -0.8, 0.48, 0], [0.48, 0.6, 0.64, 0], [-0.8, 0, 0.6, 0], [0, 0, 0, 1]])"
      "cube(size = [3, 3, 3], center = true);");
  double lowest = 0;
  for (const Vec3& corner : mesh.corners) lowest = std::min(lowest, corner.z);
  EXPECT_NEAR(lowest, -1.5, 1e-12);
  const Slicer slicer(mesh);
  EXPECT_NEAR(area(slicer.at(-1.5)), 9, 1e-9);
  EXPECT_NEAR(area(slicer.at(std::nextafter(-1.5, -2))), 9, 1e-9);
  EXPECT_TRUE(slicer.at(1.5).empty());
  EXPECT_TRUE(slicer.at(std::nextafter(1.5, 0)).empty());
}

/// Between corners areas are quadratic in z, for which Gauss's rule of two points is exact.
TEST(Slicer, AreasAddUpToTheVolume) {
  const double off = 0.5 / std::sqrt(3.0);
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    const SolidMesh mesh =
        mesh_of_text(random_tree(seed, {.primitives = 12, .coincident = seed % 2 == 0}));
    std::vector<double> heights;
    for (const Vec3& corner : mesh.corners) heights.push_back(corner.z);
    std::ranges::sort(heights);
    const Slicer slicer(mesh);
    double sum = 0;
    for (size_t i = 0; i + 1 < heights.size(); ++i) {
      const double a = heights[i], b = heights[i + 1];
      for (const double share : {0.5 - off, 0.5 + off})
        sum += (b - a) / 2 * area(slicer.at(a + share * (b - a)));
    }
    EXPECT_NEAR(sum, volume(mesh), 1e-9 * (1 + sum)) << seed;
  }
}

/// Sections are what the mesh winds around, point by point.
TEST(Slicer, HoldsThePointsThatTheSolidHolds) {
  std::mt19937 random(1);
  for (uint32_t seed = 20; seed < 26; ++seed) {
    const SolidMesh mesh = mesh_of_text(random_tree(seed, {.primitives = 20}));
    if (mesh.corners.empty()) continue;
    Box box;
    for (const Vec3& corner : mesh.corners) box.include(corner);
    const Slicer slicer(mesh);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 20; ++i) {
      const double z = box.lo.z + share(random) * box.size().z;
      const std::vector<Contour> loops = slicer.at(z);
      for (int k = 0; k < 10; ++k) {
        const Vec3 p{box.lo.x + share(random) * box.size().x,
                     box.lo.y + share(random) * box.size().y, z};
        EXPECT_EQ(winding(loops, {p.x, p.y}), winding(mesh, p)) << seed;
      }
    }
  }
}

/// With corners of every height there are many blocks, and each must be found.
TEST(Slicer, FindsEveryTriangle) {
  const SolidMesh mesh = mesh_of_text("sphere(r = 5, $fn = 60);");
  const Slicer slicer(mesh);
  for (const double z : {-4.9, -3.0, 0.0, 0.01, 3.3, 4.9}) {
    const auto crossed = std::ranges::count_if(mesh.triangles, [&](const auto& triangle) {
      const auto below = std::ranges::count_if(
          triangle.corners, [&](uint32_t corner) { return mesh.corners[corner].z <= z; });
      return below == 1 || below == 2;
    });
    // A ring's facets are of two triangles each; each facet gives one side.
    ASSERT_EQ(slicer.at(z).size(), 1u) << z;
    EXPECT_EQ(slicer.at(z)[0].size(), size_t(crossed) / 2) << z;
  }
}

TEST(Slicer, IsTheSameFromManyThreads) {
  const SolidMesh mesh = mesh_of_text(random_tree(3, {.primitives = 30}));
  const Slicer slicer(mesh);
  const auto height = [](size_t i) { return -12 + 24.0 * double(i) / 64; };
  std::vector<std::vector<Contour>> layers(64);
  Workers(4).for_parts(layers.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) layers[i] = slicer.at(height(i));
  });
  size_t loops = 0;
  for (size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i], slicer.at(height(i))) << i;
    loops += layers[i].size();
  }
  EXPECT_GT(loops, 0u);
}

TEST(Slicer, OfNothingIsNothing) {
  const SolidMesh mesh;
  EXPECT_TRUE(Slicer(mesh).at(0).empty());
}

}  // namespace
}  // namespace whittle

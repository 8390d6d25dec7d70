#include "boundary/evaluate_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "support/mesh_checks.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Scene facetted(const std::string& text) {
  return *lower(facetted_model_of(text));
}

SolidMesh solid(const Scene& scene, BoundaryStats* stats = nullptr, int threads = 2) {
  const Workers workers(threads);
  Result<SolidMesh> mesh = evaluate_solid(scene, workers, stats);
  EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
  return mesh ? *std::move(mesh) : SolidMesh{};
}

void expect_solid(const std::string& text, double its_volume) {
  const SolidMesh mesh = solid(facetted(text));
  EXPECT_EQ(manifold_fault(mesh), "") << text;
  EXPECT_NEAR(volume(mesh), its_volume, 1e-9 * its_volume + 1e-12) << text;
}

TEST(EvaluateSolid, Cube) {
  const SolidMesh mesh = solid(facetted("cube(size = [2, 3, 4], center = false);"));
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_EQ(mesh.corners.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_DOUBLE_EQ(volume(mesh), 24);
  for (const SolidMesh::Face& face : mesh.faces) EXPECT_EQ(face.owner, 1u);
}

TEST(EvaluateSolid, KnownVolumes) {
  expect_solid(
      "difference() { cube(size = 10); multmatrix([[1,0,0,2],[0,1,0,2],[0,0,1,-1],[0,0,0,1]])"
      " cube(size = [3, 4, 20]); }",
      1000 - 3 * 4 * 10);
  expect_solid(
      "difference() { cube(size = 10); multmatrix([[1,0,0,2],[0,1,0,2],[0,0,1,3],[0,0,0,1]])"
      " cube(size = [3, 4, 5]); }",
      1000 - 3 * 4 * 5);
  // Flush in a face, in an edge, in a corner.
  const auto beside = [](const char* at) {
    return std::string("cube(size = 1); multmatrix([[1,0,0,") + at + " cube(size = 1);";
  };
  expect_solid(beside("1],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"), 2);
  expect_solid(beside("1],[0,1,0,1],[0,0,1,0],[0,0,0,1]])"), 2);
  expect_solid(beside("1],[0,1,0,1],[0,0,1,1],[0,0,0,1]])"), 2);
  expect_solid(beside("1],[0,1,0,0.5],[0,0,1,0],[0,0,0,1]])"), 2);
  expect_solid("cylinder(h = 2, r1 = 1, r2 = 1, $fn = 4);", 4);
}

TEST(EvaluateSolid, FlushFacesAreOne) {
  const SolidMesh mesh =
      solid(facetted("cube(size = 1); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
                     "cube(size = 1);"));
  EXPECT_EQ(mesh.corners.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 6u);
}

/// Cubes where x + y + z is even: every inner edge touches two of them, every inner corner four.
TEST(EvaluateSolid, CheckerboardComesApart) {
  std::string text;
  int count = 0;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) {
        if ((x + y + z) % 2 != 0) continue;
        ++count;
        text += "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) +
                "],[0,0,1," + std::to_string(z) + "],[0,0,0,1]]) cube(size = 1);\n";
      }
  BoundaryStats stats;
  const SolidMesh mesh = solid(facetted(text), &stats);
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_DOUBLE_EQ(volume(mesh), count);
  EXPECT_GT(stats.shared_edges, 0u);
  EXPECT_EQ(mesh.corners.size(), size_t(8 * count));
}

/// Two notches in a block that touch in an edge: the block is around both of its ends, so its two
/// halves cannot come apart there.
TEST(EvaluateSolid, AnEdgeBetweenTheSameCornersTwiceGetsAMiddle) {
  const std::string text =
      "difference() { translate([-1, -1, -1]) cube(size = [2, 2, 3]);"
      " translate([0, 0, 0]) cube(size = [2, 2, 1]);"
      " translate([-2, -2, 0]) cube(size = [2, 2, 1]); }";
  BoundaryStats stats;
  const SolidMesh mesh = solid(facetted(text), &stats);
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_DOUBLE_EQ(volume(mesh), 10);
  EXPECT_EQ(stats.shared_edges, 1u);
  EXPECT_EQ(std::ranges::count(mesh.corners, Vec3{0, 0, 0.5}), 1);
}

// Planes of neighbours that cannot be told apart on a sliver were one there, and what met it at an
// edge had a part in front of it.
TEST(EvaluateSolid, ATorusHasTheCornersThatItIsMadeOf) {
  const SolidMesh mesh =
      solid(facetted("rotate_extrude($fn = 100) translate([20, 0, 0]) circle($fn = 100, $fa = 12, "
                     "$fs = 2, r = 4);"));
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_EQ(mesh.corners.size(), 10000u);
  EXPECT_NEAR(volume(mesh), 6308.238948418, 1e-6);
}

TEST(EvaluateSolid, NothingAndNoEnd) {
  EXPECT_TRUE(solid(facetted("")).triangles.empty());
  EXPECT_TRUE(
      solid(facetted("difference() { cube(size = 1); cube(size = 1); }")).triangles.empty());
  const Workers workers(1);
  EXPECT_FALSE(evaluate_solid(facetted("halfspace([1, 0, 0], 1);"), workers));
  EXPECT_FALSE(evaluate_solid(*lower(model_of("sphere(r = 1);")), workers));
}

TEST(EvaluateSolid, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene = facetted(random_tree(1, {.primitives = 800, .coincident = true}));
  BoundaryStats stats;
  const SolidMesh one = solid(scene, &stats, 1);
  EXPECT_GT(stats.leaves, 100u);
  for (const int threads : {2, 5}) {
    const SolidMesh many = solid(scene, nullptr, threads);
    EXPECT_EQ(many.corners, one.corners);
    ASSERT_EQ(many.triangles.size(), one.triangles.size());
    for (size_t i = 0; i < many.triangles.size(); ++i)
      ASSERT_EQ(many.triangles[i].corners, one.triangles[i].corners);
  }
}

/// Points of a mesh's box are inside of it if they are in the scene.
void expect_same_points(const Scene& scene, const SolidMesh& mesh, uint64_t seed,
                        const std::string& text) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 40; ++i) {
    Vec3 p = scene.region.lo;
    for (int k = 0; k < 3; ++k) p[k] += share(random) * scene.region.size()[k];
    const bool is_near =
        std::any_of(scene.half_spaces.begin(), scene.half_spaces.end(), [&](const HalfSpace& h) {
          return std::fabs(Kernels<double>::quadric_value(h.f, p - h.center)) < 1e-6;
        });
    if (is_near) continue;
    EXPECT_EQ(winding(mesh, p + scene.origin), contains(scene, scene.formula, p) ? 1 : 0) << text;
  }
}

class EvaluateRandom : public testing::TestWithParam<RandomTreeOptions> {};

TEST_P(EvaluateRandom, IsClosedAndTheSameSolid) {
  for (int seed = 1; seed <= 60; ++seed) {
    const std::string text = random_tree(uint64_t(seed), GetParam());
    const Scene scene = facetted(text);
    BoundaryStats stats;
    const SolidMesh mesh = solid(scene, &stats);
    EXPECT_EQ(manifold_fault(mesh), "") << "seed " << seed;
    if (scene.boundaries.empty()) {
      EXPECT_LE(stats.joins, 1u) << "seed " << seed;
    }
    expect_same_points(scene, mesh, uint64_t(seed), "seed " + std::to_string(seed));
    if (HasFailure()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Trees, EvaluateRandom,
    testing::Values(RandomTreeOptions{.primitives = 8},
                    RandomTreeOptions{.primitives = 14, .coincident = true},
                    RandomTreeOptions{.primitives = 14, .coincident = true, .nearly = true}));

/// Balls that cut one another in a block: most facets are whole or gone, and no cell is made.
TEST(EvaluateSolid, FacesThatNoOtherLiesOnNeedNoCells) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-4, 4);
  std::string text = "difference() { cube(size = 8, center = true);";
  for (int i = 0; i < 30; ++i) {
    text += "multmatrix([[1,0,0," + std::to_string(place(random)) + "],[0,1,0," +
            std::to_string(place(random)) + "],[0,0,1," + std::to_string(place(random)) +
            "],[0,0,0,1]]) sphere(r = 1.3, $fn = 20);";
  }
  const Scene scene = facetted(text + "}");
  BoundaryStats stats;
  const SolidMesh mesh = solid(scene, &stats);
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_EQ(stats.leaves, 0u);
  EXPECT_GT(stats.whole_planes, 5000u);
  expect_same_points(scene, mesh, 1, "balls");
}

/// Thousands of copies of few bodies: no face is cut into ever smaller parts of the same.
TEST(EvaluateSolid, FacesThatManyCopiesReach) {
  std::string text = "difference() { cube(size = 10);";
  for (int i = 0; i < 20000; ++i)
    text += "cube(size = " + std::to_string(1 + i % 3) + ", center = true);";
  BoundaryStats stats;
  const SolidMesh mesh = solid(facetted(text + "}"), &stats);
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_NEAR(volume(mesh), 1000 - 1.5 * 1.5 * 1.5, 1e-9);
  EXPECT_LT(stats.pieces, 5000u);
}

/// What is asked as a whole and what cells cut are the same: the outlines and the solid.
TEST(EvaluateSolid, FacesAndCellsAgree) {
  size_t whole = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = facetted(random_tree(
        seed, {.primitives = 14, .coincident = seed % 3 == 1, .nearly = seed % 3 == 2}));
    const Workers workers(2);
    BoundaryStats faces, cells;
    const Result<SolidMesh> one = evaluate_solid(scene, workers, &faces),
                            other = evaluate_solid(scene, workers, &cells, {.whole_faces = false});
    ASSERT_TRUE(one && other);
    whole += faces.whole_planes;
    EXPECT_EQ(cells.whole_planes, 0u);
    EXPECT_EQ(faces.outline_edges, cells.outline_edges);
    EXPECT_EQ(faces.shared_edges, cells.shared_edges);
    EXPECT_NEAR(volume(*one), volume(*other), 1e-12 * std::max(1.0, volume(*other)));
  }
  EXPECT_GT(whole, 1000u);
}

/// How much of what is outward there is of each body.
std::map<uint32_t, double> areas(const SolidMesh& mesh, Vec3 outward) {
  std::map<uint32_t, double> areas;
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const SolidMesh::Face& face = mesh.faces[triangle.face];
    if (dot(face.outward, outward) < 1 - 1e-12) continue;
    const auto& [a, b, c] = triangle.corners;
    areas[face.owner] +=
        length(cross(mesh.corners[b] - mesh.corners[a], mesh.corners[c] - mesh.corners[a])) / 2;
  }
  return areas;
}

SolidMesh painted(const std::string& text, const std::vector<uint32_t>& paints) {
  const Scene scene = facetted(text);
  const Workers workers(2);
  Result<SolidMesh> mesh = evaluate_solid(scene, workers, nullptr, {.paints = paints});
  EXPECT_TRUE(mesh);
  EXPECT_EQ(manifold_fault(*mesh), "");
  return *std::move(mesh);
}

std::string at(const std::string& x) {
  return "multmatrix([[1,0,0," + x + "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) ";
}

TEST(EvaluateSolid, PaintsAreApartInOnePlane) {
  using Areas = std::map<uint32_t, double>;
  // Beside one another, with a gap, overlapping, and one in the other.
  const std::string beside = "cube(1);" + at("1") + "cube(1);";
  EXPECT_EQ(areas(painted(beside, {}), {0, 0, 1}), (Areas{{1, 2}}));
  EXPECT_EQ(areas(painted(beside, {0, 1, 1}), {0, 0, 1}), (Areas{{1, 2}}));
  EXPECT_EQ(areas(painted(beside, {0, 1, 2}), {0, 0, 1}), (Areas{{1, 1}, {2, 1}}));
  const std::string aside = "cube(1);" + at("3") + "cube(1);";
  EXPECT_EQ(areas(painted(aside, {0, 1, 2}), {0, 0, -1}), (Areas{{1, 1}, {2, 1}}));
  // The first in the file owns what both have.
  const std::string over = "cube(1);" + at("0.25") + "cube(1);";
  EXPECT_EQ(areas(painted(over, {0, 1, 2}), {0, 0, 1}), (Areas{{1, 1}, {2, 0.25}}));
  const std::string within =
      "cube([4, 4, 1]); multmatrix([[1,0,0,1],[0,1,0,1],[0,0,1,0],[0,0,0,1]])"
      "cube(1);";
  EXPECT_EQ(areas(painted(within, {0, 1, 2}), {0, 0, 1}), (Areas{{1, 16}}));
  // Of a plate the cutter is first asked, then what fills a part of the hole.
  const std::string inlay =
      "difference() { cube([4, 4, 1]); multmatrix([[1,0,0,1],[0,1,0,1],[0,0,1,-1],[0,0,0,1]])"
      "cube([2, 2, 3]); } multmatrix([[1,0,0,1],[0,1,0,1],[0,0,1,0],[0,0,0,1]]) cube([2, 1, 1]);";
  EXPECT_EQ(areas(painted(inlay, {0, 1, 2, 3}), {0, 0, 1}), (Areas{{1, 12}, {3, 2}}));
  EXPECT_EQ(areas(painted(inlay, {0, 1, 2, 3}), {0, 1, 0}), (Areas{{1, 4}, {3, 2}}));
}

/// Who owns what is between two points, as the tie rules say it of the whole formula.
uint32_t owner_between(const Scene& scene, Vec3 inside, Vec3 outside) {
  const auto changes = [&](const Operand& operand) {
    return contains(scene, operand.tokens, inside) != contains(scene, operand.tokens, outside);
  };
  Operand at = whole(scene.formula);
  while (at.is_group()) {
    const Operands operands = operands_of(at);
    const auto chosen = std::ranges::find_if(operands, changes);
    if (chosen == operands.end()) return 0;
    at = *chosen;
  }
  return scene.units[at.token().payload()].id;
}

TEST(EvaluateSolid, EveryPaintedFaceIsItsOwners) {
  size_t checked = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = random_tree(seed, {.primitives = 14, .coincident = true});
    const Scene scene = facetted(text);
    uint32_t most = 0;
    for (const Unit& unit : scene.units) most = std::max(most, unit.id);
    std::vector<uint32_t> paints(most + 1);
    std::iota(paints.begin(), paints.end(), 0u);
    const SolidMesh mesh = painted(text, paints), plain = painted(text, {});
    EXPECT_NEAR(volume(mesh), volume(plain), 1e-9 * volume(plain));
    for (const SolidMesh::Triangle& triangle : mesh.triangles) {
      const auto& [a, b, c] = triangle.corners;
      const Vec3 ab = mesh.corners[b] - mesh.corners[a], ac = mesh.corners[c] - mesh.corners[a];
      constexpr double kStep = 1e-3;
      // In the middle of what is no sliver.
      if (length(cross(ab, ac)) < 100 * kStep * std::max(length(ab), length(ac))) continue;
      const Vec3 middle = mesh.corners[a] + (ab + ac) / 3 - scene.origin;
      const SolidMesh::Face& face = mesh.faces[triangle.face];
      const Vec3 step = face.outward * kStep;
      if (const uint32_t id = owner_between(scene, middle - step, middle + step); id != 0) {
        EXPECT_EQ(face.owner, id);
        ++checked;
      }
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(checked, 3000u);
}

}  // namespace
}  // namespace whittle

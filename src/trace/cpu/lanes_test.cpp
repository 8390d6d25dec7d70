// Leaves solved in lanes against LeafSolver, ray by ray: the same bits.
#include "trace/cpu/lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>

#include "base/degrees.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "support/instruction_sets.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

std::vector<Hit> hits_of(const LaneScene& scene, const Camera& camera) {
  std::vector<PixelPosition> positions;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) positions.push_back({float(x) + 0.5f, float(y) + 0.5f});
  std::array<uint32_t, kTileRays> places;
  for (uint32_t i = 0; i < kTileRays; ++i) places[i] = i;
  std::vector<Hit> hits(positions.size());
  LaneScratch scratch(scene);
  const std::span<const PixelPosition> all = positions;
  for (size_t i = 0; i < all.size(); i += kTileRays)
    trace_lanes(scene, camera, all.subspan(i, std::min(kTileRays, all.size() - i)), places.data(),
                &hits[i], scratch);
  return hits;
}

/// Demands the same bits of both on every instruction set; returns how many rays hit something.
size_t expect_same(const Scene& scene, const SubdivideSettings& settings,
                   std::span<const Camera> cameras) {
  size_t hit = 0;
  const CellTree cells = subdivide(scene, settings);
  if (cells.region.is_empty()) return 0;
  LaneScene in_lanes(scene, cells), alone(scene, cells);
  alone.solves_in_lanes = false;
  for (const Camera& camera : cameras) {
    const std::vector<Hit> expected = hits_of(alone, camera);
    for_every_instruction_set([&] {
      const std::vector<Hit> hits = hits_of(in_lanes, camera);
      EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(Hit)), 0);
    });
    for (const Hit& h : expected) hit += h.hit();
  }
  return hit;
}

TEST(Lanes, SolveLeavesAsLeafSolverDoes) {
  size_t hit = 0;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const Model model = model_of(random_tree(seed, {.primitives = 24,
                                                    .coincident = seed % 4 >= 2,
                                                    .nearly = seed % 4 == 3,
                                                    .halfspaces = seed % 3 == 0}));
    SubdivideSettings settings;
    settings.leaf_size = seed % 5 == 0 ? 3 : 6;
    hit += expect_same(*lower(model), settings, cameras_for(model, 52, 39));
  }
  EXPECT_GT(hit, 20000u);
}

TEST(Lanes, SolveLongConjunctionsAndDisjunctionsAsLeafSolverDoes) {
  // Leaves of 7 literals and more, of one group, and without a table: around balls that are cut
  // out, or left, in cells as large as they.
  std::string balls;
  for (int i = 0; i < 60; ++i)
    balls += "translate([" + std::to_string(i * 7 % 20) + "," + std::to_string(i * 11 % 19) + "," +
             std::to_string(i * 13 % 17) + "]) sphere(3.7);";
  for (const std::string& text :
       {"difference() { cube(20); " + balls + "}", "union() {" + balls + "}"}) {
    const Model model = model_of(text);
    const Scene scene = *lower(model);
    for (const uint32_t leaf_size : {10, 16, 24}) {
      SubdivideSettings settings;
      settings.leaf_size = leaf_size;
      const SubdivideStats stats = statistics_of(subdivide(scene, settings));
      size_t longer = 0;
      for (size_t n = kTableLiterals + 1; n < stats.leaves_by_size.size(); ++n)
        longer += stats.leaves_by_size[n];
      EXPECT_GT(longer, 5u);
      EXPECT_GT(expect_same(scene, settings, cameras_for(model, 64, 48)), 2000u);
    }
  }
}

TEST(Lanes, RunProgramsAsLeafSolverDoes) {
  // Up to all that is kept of literals and steps, and beyond.
  size_t hit = 0;
  std::array<size_t, 3> programs{};
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Model model = model_of(random_tree(
        seed, {.primitives = 60, .coincident = seed % 4 >= 2, .nearly = seed % 4 == 3}));
    const Scene scene = *lower(model);
    SubdivideSettings settings;
    settings.leaf_size = std::array{9u, 30u, 90u}[seed % 3];
    const SubdivideStats stats = statistics_of(subdivide(scene, settings));
    programs[seed % 3] += stats.cells[size_t(CellKind::kProgram)];
    hit += expect_same(scene, settings, cameras_for(model, 52, 39));
  }
  for (const size_t count : programs) EXPECT_GT(count, 10u);
  EXPECT_GT(hit, 10000u);
}

/// Parallel rays in one row of pixels, from `from` on along `row`.
Camera row_of_rays(Vec3 from, Vec3 row, Vec3 direction, double length) {
  Camera camera;
  camera.eye = from + row * (0.5 * length);
  camera.right = row;
  camera.forward = direction;
  camera.up = cross(row, direction);
  camera.orthographic = true;
  camera.width = 400, camera.height = 1;
  camera.half_height = 0.5 * length / camera.width;
  return camera;
}

TEST(Lanes, LeaveCrossingsThatHappenTogetherToLeafSolver) {
  // A slope that goes on beyond its wedge and meets the cube's top just where the rays do.
  const std::string wedge =
      "polyhedron(points = [[0,6,0],[3,6,0],[0,6,3],[0,8,0],[3,8,0],[0,8,3]],"
      " faces = [[0,2,1],[3,4,5],[0,1,4,3],[1,2,5,4],[2,0,3,5]]);"
      "translate([0,0,-1]) cube([4,4,2]);";
  // A round bar that touches the square one around it in lines, turned by an odd angle.
  const std::string bars =
      "rotate([30, 0, 17]) { rotate([0, 90, 0]) cylinder(h = 40, r = 2);"
      " translate([0, -2, -2]) cube([40, 4, 4]); }";
  const double c = cos_degrees(17), s = sin_degrees(17), cx = cos_degrees(30), sx = 0.5;
  const Affine turn = {.row = {{c, -s * cx, s * sx}, {s, c * cx, -c * sx}, {0, sx, cx}},
                       .translation = {}};
  const Camera along_slope = row_of_rays({2, 0, 10}, {0, 1, 0}, {0, 0, -1}, 4);
  const Camera along_touch =
      row_of_rays(turn.point({0, 0, 10}), turn.vector({1, 0, 0}), turn.vector({0, 0, -1}), 40);
  for (const uint32_t leaf_size : {2, 6, 16}) {
    SubdivideSettings settings;
    settings.leaf_size = leaf_size;
    EXPECT_EQ(expect_same(*lower(model_of(wedge)), settings, {&along_slope, 1}), 400u);
    EXPECT_EQ(expect_same(*lower(model_of(bars)), settings, {&along_touch, 1}), 400u);
  }
}

}  // namespace
}  // namespace whittle

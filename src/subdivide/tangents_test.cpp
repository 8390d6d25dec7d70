#include "subdivide/tangents.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Scene scene_of(const std::string& text) {
  return *lower(model_of(text));
}

TEST(Tangents, APlaneIsItsOwnTangent) {
  const Scene scene = scene_of("halfspace(n = [1, 2, 2], d = 6);");
  const auto t = tangent(scene, scene.faces[0].literal, Vec3{1, 1, 0} - scene.origin);
  ASSERT_TRUE(t);
  EXPECT_NEAR(length(t->plane.n - Vec3{1, 2, 2} / 3), 0, 1e-15);
  EXPECT_NEAR(t->plane.d, 1, 1e-12);  // (6 - 3) / 3
  EXPECT_EQ(outer_plane(*t, {5, 5, 5}).d, t->plane.d);
}

TEST(Tangents, ThereIsNoneInTheMiddleOfABall) {
  const Scene scene = scene_of("sphere(5);");
  EXPECT_FALSE(tangent(scene, 0, scene.half_spaces[0].center));
}

TEST(Tangents, TheRimOfTwoSurfacesIsFoundFromAFarCell) {
  // A ball with a bore: the rim is at z = 8, and no cell is small here.
  const Scene scene = scene_of("difference(){ sphere(10); cylinder(h=40,r=6,center=true); }");
  ASSERT_GE(scene.faces.size(), 2u);
  const Vec3 center = Vec3{6, 0.3, 8.1} - scene.origin, half{0.5, 0.5, 0.1};
  std::vector<Tangent> walls;
  for (const Face& face : scene.faces)
    if (!scene.half_spaces[face.literal >> 1].is_plane())
      walls.push_back(*tangent(scene, face.literal ^ uint32_t(!walls.empty()), center));
  ASSERT_EQ(walls.size(), 2u);
  const Tangent* both[] = {&walls[0], &walls[1]};
  const Vec3 up{0, 0, 1};
  const double reach = center.z + scene.origin.z + combined_reach(both, up, half);
  EXPECT_GE(reach, 8 - 1e-12);
  EXPECT_LE(reach, 8.01);
  EXPECT_GT(combined_reach({both, 1}, up, half), 0.1) << "the ball alone reaches farther";
}

TEST(Tangents, BoundsHoldForEveryPointOfTheCell) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int points = 0, finite = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene = scene_of(random_tree(seed));
    if (scene.half_spaces.size() < 3) continue;
    for (int cell = 0; cell < 30; ++cell) {
      // Near a surface, so that something is left of the cell.
      const Vec3 center{unit(random) * 8, unit(random) * 8, unit(random) * 8};
      const Vec3 half{0.1 + unit(random) * 0.09, 1 + unit(random) * 0.9, 1 + unit(random) * 0.9};
      Literal literals[3];
      std::vector<Tangent> tangents;
      for (Literal& literal : literals) {
        literal = Literal(random() % (2 * scene.half_spaces.size()));
        if (const auto t = tangent(scene, literal, center)) tangents.push_back(*t);
      }
      if (tangents.size() < 3) continue;
      const Tangent* all[] = {&tangents[0], &tangents[1], &tangents[2]};
      Vec3 objective{};
      objective[int(random() % 3)] = random() % 2 ? 1 : -1;
      const double reach = combined_reach(all, objective, half);
      finite += std::isfinite(reach);
      for (int i = 0; i < 50; ++i) {
        const Vec3 q{unit(random) * half.x, unit(random) * half.y, unit(random) * half.z};
        bool inside = true;
        for (size_t k = 0; k < 3; ++k) {
          if (!contains(scene, literals[k], center + q)) {
            inside = false;
            continue;
          }
          const Constraint plane = outer_plane(tangents[k], half);
          ASSERT_LE(dot(plane.n, q), plane.d + 1e-9) << seed;
        }
        if (!inside) continue;
        ++points;
        ASSERT_LE(dot(objective, q), reach + 1e-9) << seed;
      }
    }
  }
  EXPECT_GT(points, 5000);
  EXPECT_GT(finite, 500);
}

}  // namespace
}  // namespace whittle

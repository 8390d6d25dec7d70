#include "measure/measure.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "measure/material.h"
#include "model/instances.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Measures measures_of(const Model& model, double within = 1e-6) {
  const Result<Measures> measures = measure(model, {.within = within, .threads = 2});
  EXPECT_TRUE(measures) << (measures ? "" : measures.error().message);
  return measures ? *measures : Measures{};
}

void expect_near(Vec3 found, Vec3 wanted, double bound) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], bound);
}

TEST(Measure, BoxOfPlanes) {
  const Mass mass = measures_of(model_of("cube(size = [1, 2, 3]);")).whole;
  EXPECT_TRUE(mass.is_facetted && mass.is_within);
  EXPECT_NEAR(mass.volume.value, 6, 1e-14);
  EXPECT_LT(mass.volume.bound, 1e-10);
  EXPECT_NEAR(mass.area.value, 22, 1e-13);
  expect_near(mass.centroid, {0.5, 1, 1.5}, 1e-14);
  expect_near(mass.moments, {6 * 13 / 12.0, 6 * 10 / 12.0, 6 * 5 / 12.0}, 1e-13);
  expect_near(mass.products, {}, 1e-13);
  EXPECT_LT(mass.inertia_bound, 1e-9);
}

TEST(Measure, ProductsOfInertia) {
  // Two cubes along the diagonal of x and y.
  const Mass mass = measures_of(model_of("cube(size = 1, center = true);"
                                         "multmatrix([[1,0,0,2],[0,1,0,4],[0,0,1,0],[0,0,0,1]])"
                                         "cube(size = 1, center = true);"))
                        .whole;
  expect_near(mass.centroid, {1, 2, 0}, 1e-14);
  expect_near(mass.products, {0, 0, -4}, 1e-13);
  expect_near(mass.moments, {2 / 6.0 + 8, 2 / 6.0 + 2, 2 / 6.0 + 10}, 1e-13);
}

TEST(Measure, FarFromTheOrigin) {
  const Mass mass = measures_of(model_of("multmatrix([[1,0,0,1e6],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                                         "cube(size = 1, center = true);"))
                        .whole;
  EXPECT_NEAR(mass.volume.value, 1, 1e-9);
  expect_near(mass.centroid, {1e6, 0, 0}, 1e-9);
  expect_near(mass.moments, Vec3{1, 1, 1} * (1 / 6.0), 1e-9);
}

TEST(Measure, Ball) {
  const double volume = 4 * std::numbers::pi / 3;
  const Mass mass = measures_of(model_of("multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]])"
                                         "sphere(r = 1);"))
                        .whole;
  EXPECT_FALSE(mass.is_facetted);
  EXPECT_TRUE(mass.is_within);
  EXPECT_NEAR(mass.volume.value, volume, mass.volume.bound);
  expect_near(mass.centroid, {5, 0, 0}, mass.centroid_bound);
  expect_near(mass.moments, Vec3{1, 1, 1} * (0.4 * volume), mass.inertia_bound);
  expect_near(mass.products, {}, mass.inertia_bound);
  EXPECT_LT(mass.centroid_bound, 1e-4);
  EXPECT_LT(mass.inertia_bound, 1e-4);
}

/// A regular polygon revolved: Pappus and Guldin with chords in place of circles.
TEST(Measure, Torus) {
  const Mass mass =
      measures_of(model_of("rotate_extrude($fn = 60) multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],"
                           "[0,0,0,1]]) circle(r = 1, $fn = 40);"))
          .whole;
  EXPECT_TRUE(mass.is_facetted);
  const double circle = 40 * std::sin(std::numbers::pi / 20) / 2;
  const double around = 60 * std::sin(2 * std::numbers::pi / 60);
  EXPECT_NEAR(mass.volume.value, circle * 3 * around, 1e-3);
  expect_near(mass.centroid, {}, 1e-6);
  // The true curve: cones instead of chords.
  const Mass smooth =
      measures_of(model_of("rotate_extrude($fn = 0) multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],"
                           "[0,0,0,1]]) circle(r = 1, $fn = 40);"))
          .whole;
  EXPECT_NEAR(smooth.volume.value, circle * 3 * 2 * std::numbers::pi,
              smooth.volume.bound + 1e-5 * smooth.volume.value);
}

TEST(Measure, FacetsAndCurvesOfTheSameFlatModel) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Model model = facetted_model_of(random_tree(seed, {.primitives = 6}));
    const Mass exact = measures_of(model).whole;
    const Scene scene = *lower(model);
    EXPECT_TRUE(exact.is_facetted);
    // Counted: a fixed set of points.
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const Vec3 size = scene.region.size();
    int inside = 0;
    constexpr int kPoints = 40'000;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 p = scene.region.lo +
                     Vec3{share(random) * size.x, share(random) * size.y, share(random) * size.z};
      inside += contains(scene, scene.formula, p);
    }
    const double box = size.x * size.y * size.z, p = exact.volume.value / box;
    EXPECT_NEAR(double(inside) / kPoints, p, 5 * std::sqrt((p + 1e-3) / kPoints)) << seed;
  }
}

TEST(Measure, RefusesWhatHasNoVolume) {
  const Result<Measures> flat = measure(model_of("square(size = 1);"));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().message, "what is flat has no volume");
  const Result<Measures> endless = measure(model_of("halfspace(n = [0, 0, 1], d = 0);"));
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().message, "the solid has no end, so no volume");
}

TEST(Measure, EmptyIsEmpty) {
  const Mass mass = measures_of(model_of("cube(size = 0);")).whole;
  EXPECT_EQ(mass.volume.value, 0);
  EXPECT_EQ(mass.centroid_bound, kInfinity);
}

TEST(Measure, ColorsShareTheSolid) {
  // Red comes first and keeps what both hold; the hole belongs to nobody.
  const Measures measures =
      measures_of(model_of("difference() { union() { color([1, 0, 0, 1]) cube(size = 2);"
                           "multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size = 2); }"
                           "color([0, 1, 0, 1]) cube(size = 1); }"));
  ASSERT_EQ(measures.colors.size(), 2u);
  EXPECT_EQ(measures.color_count, 3u);
  EXPECT_EQ(measures.colors[0].color, (Rgba{1, 0, 0, 1}));
  EXPECT_EQ(measures.colors[1].color, std::nullopt);
  EXPECT_NEAR(measures.colors[0].mass.volume.value, 7, 1e-12);
  EXPECT_NEAR(measures.colors[1].mass.volume.value, 4, 1e-12);
  EXPECT_NEAR(measures.whole.volume.value, 11, 1e-12);
}

/// At random points, the formulas of all colours together are the solid, and one of them at most
/// holds, the one that the tree's own descent finds.
TEST(Material, EachPointHasOneOwner) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const Scene scene = *lower(model_of(random_tree(seed, {.primitives = 10})));
    constexpr uint32_t kParts = 3;
    std::array<Formula, kParts> parts;
    for (uint32_t i = 0; i < kParts; ++i) {
      const auto is_wanted = [&](uint32_t id) { return id % kParts == i; };
      parts[i] = *material_of(scene, is_wanted, 1'000'000);
    }
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const Vec3 size = scene.region.is_empty() ? Vec3{} : scene.region.size();
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = scene.region.lo +
                     Vec3{share(random) * size.x, share(random) * size.y, share(random) * size.z};
      // The first operand that holds the point, down to a primitive.
      uint32_t owner = 0;
      Operand at = whole(scene.formula);
      const bool is_inside = contains(scene, scene.formula, p);
      while (is_inside && at.is_group()) {
        for (const Operand operand : operands_of(at)) {
          const bool is_any = at.token().kind() == TokenKind::kOr;
          if (is_any && !contains(scene, operand.tokens, p)) continue;
          at = operand_at(scene.formula, operand.index);
          break;
        }
      }
      if (is_inside) {
        const Token token = at.token();
        owner = scene
                    .units[token.kind() == TokenKind::kUnit ? token.payload()
                                                            : scene.faces[token.payload()].unit]
                    .id;
      }
      for (uint32_t part = 0; part < kParts; ++part)
        EXPECT_EQ(contains(scene, parts[part], p), is_inside && owner % kParts == part)
            << "seed " << seed;
    }
  }
}

TEST(Material, TooMuchIsSaid) {
  const Scene scene = *lower(model_of(random_tree(3)));
  const auto is_wanted = [](uint32_t id) { return id % 2 == 0; };
  const Result<Formula> part = material_of(scene, is_wanted, 1);
  ASSERT_FALSE(part);
  EXPECT_EQ(part.error().kind, ErrorKind::kMachine);
}

}  // namespace
}  // namespace whittle

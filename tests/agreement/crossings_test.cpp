// All crossings of a ray: known ones, and the cpu backend's against the oracle's, over random
// trees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "agreement/cpu_subject.h"
#include "model/instances.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

SubdivideSettings cells_of(uint32_t leaf_size) {
  SubdivideSettings settings;
  settings.leaf_size = leaf_size;
  return settings;
}

std::string describe(std::span<const SurfaceCrossing> crossings) {
  std::string text;
  for (const SurfaceCrossing& c : crossings)
    text += fmt::format(" {}{}@{:.17g}", c.enters ? '+' : '-', c.id, c.distance);
  return text.empty() ? " none" : text;
}

/// The crossings of one ray, by both backends, which agree to the sixth digit.
std::vector<SurfaceCrossing> crossings_of(const std::string& text, const Ray& ray) {
  const Model model = model_of(text, "known");
  const auto oracle = make_oracle_tracer(model);
  CpuSubject cpu(model, cells_of(kAutoLeafSize));
  RayCrossings by_oracle, by_cpu;
  oracle->cast_through({&ray, 1}, by_oracle);
  cpu.tracer->cast_through({&ray, 1}, by_cpu);
  const auto a = by_oracle.of(0), b = by_cpu.of(0);
  EXPECT_EQ(a.size(), b.size()) << describe(a) << " and" << describe(b);
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].enters, b[i].enters);
    EXPECT_NEAR(a[i].distance, b[i].distance, 1e-12 * std::max(1.0, std::fabs(a[i].distance)));
    EXPECT_LT(length(a[i].normal - b[i].normal), 1e-9);
  }
  return {b.begin(), b.end()};
}

void expect_crossings(const std::string& text, const Ray& ray, const std::string& expected) {
  std::string found;
  for (const SurfaceCrossing& c : crossings_of(text, ray))
    found += fmt::format("{}{}@{:.6g} ", c.enters ? '+' : '-', c.id, c.distance);
  EXPECT_EQ(found, expected) << text;
}

TEST(Crossings, OfWhatIsKnown) {
  const Ray along_x{{-10, 0.1, 0.2}, {1, 0, 0}};
  expect_crossings("cube(2, center = true);", along_x, "+1@9 -1@11 ");
  expect_crossings(
      "cube([2, 9, 9], center = true);"
      "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(2, center = true);",
      along_x, "+1@9 -1@11 +2@14 -2@16 ");
  // What is cut away belongs to the cutter.
  expect_crossings("difference() { cube(8, center = true); cube(2, center = true); }", along_x,
                   "+1@6 -2@9 +2@11 -1@14 ");
  expect_crossings("sphere(5);", {{-10, 0, 3}, {1, 0, 0}}, "+1@6 -1@14 ");
  expect_crossings("sphere(5);", {{-10, 0, 6}, {1, 0, 0}}, "");
}

TEST(Crossings, TouchingSolidsShareNothing) {
  const char* kMoved = "multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) ";
  const Ray along_x{{-10, 0.1, 0.2}, {1, 0, 0}};
  expect_crossings(fmt::format("cube(2, center = true); {}cube(2, center = true);", kMoved),
                   along_x, "+1@9 -2@13 ");
  // Once more with a film as thin as files round, and a cutter that is flush.
  expect_crossings(
      fmt::format("difference() {{ cube(2, center = true); {}cube(2, center = true); }}", kMoved),
      along_x, "+1@9 -1@11 ");
  expect_crossings("difference() { cube(2, center = true); cube(2, center = true); }", along_x, "");
}

TEST(Crossings, ARayThatStartsInTheSolidFirstLeavesIt) {
  expect_crossings("cube(2, center = true);", {{0, 0.1, 0.2}, {1, 0, 0}}, "-1@1 ");
  expect_crossings("cube(2, center = true);", {{0, 0.1, 0.2}, {1, 0, 0}, 2}, "");
  // On a surface it has passed that.
  expect_crossings("cube(2, center = true);", {{-1, 0.1, 0.2}, {1, 0, 0}}, "-1@2 ");
}

TEST(Crossings, ASolidWithoutEndIsNotLeft) {
  expect_crossings("halfspace(n = [1, 0, 0], d = 3); ", {{-7, 0.1, 0.2}, {1, 0, 0}}, "-1@10 ");
  expect_crossings("halfspace(n = [1, 0, 0], d = 3); ", {{7, 0.1, 0.2}, {-1, 0, 0}}, "+1@4 ");
}

TEST(Crossings, NormalsPointToTheEmptySide) {
  const std::vector<SurfaceCrossing> found =
      crossings_of("difference() { sphere(5); sphere(3); }", {{-10, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(found.size(), 4u);
  for (const SurfaceCrossing& c : found) EXPECT_NEAR(c.normal.x, c.enters ? -1 : 1, 1e-12);
}

/// Rays across a model of about 12 units: from outside, from inside, and square to the axes.
std::vector<Ray> random_rays(uint64_t seed, size_t count) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * double(random() >> 11) * 0x1p-53;
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3 inner{uniform(-8, 8), uniform(-8, 8), uniform(-8, 8)};
    Vec3 way = normalize(Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
    if (rays.size() % 4 == 1)
      way = {rays.size() % 8 == 1 ? 1.0 : 0.0, 0, rays.size() % 8 == 1 ? 0.0 : -1.0};
    rays.push_back({rays.size() % 3 == 0 ? inner : inner - way * 40.0, way, 0});
  }
  return rays;
}

bool same_sequence(std::span<const SurfaceCrossing> a, std::span<const SurfaceCrossing> b) {
  return std::ranges::equal(a, b, [](const SurfaceCrossing& x, const SurfaceCrossing& y) {
    return x.id == y.id && x.enters == y.enters;
  });
}

/// The same points, but for rounding, which a surface that is nearly along the ray makes large.
bool same_crossings(const Ray& ray, std::span<const SurfaceCrossing> a,
                    std::span<const SurfaceCrossing> b) {
  if (!same_sequence(a, b)) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    const double steepness = std::fabs(dot(a[i].normal, ray.direction));
    if (!(std::fabs(a[i].distance - b[i].distance) <= 1e-11 / std::max(steepness, 1e-6)))
      return false;
    if (!(length(cross(a[i].normal, b[i].normal)) <= 1e-6 && dot(a[i].normal, b[i].normal) > 0))
      return false;
  }
  return true;
}

struct Verdict {
  size_t rays = 0, crossings = 0, most = 0, ambiguous = 0;
};

/// Where the answers differ the oracle is asked again a hundred-thousandth beside the ray. If that
/// is another answer, the ray all but touches an edge, and any of the answers will do.
void compare(const Model& model, uint32_t leaf_size, std::span<const Ray> rays, Verdict& sum) {
  const auto oracle = make_oracle_tracer(model);
  CpuSubject cpu(model, cells_of(leaf_size));
  RayCrossings expected, found;
  oracle->cast_through(rays, expected);
  cpu.tracer->cast_through(rays, found);
  ASSERT_EQ(found.ends.size(), rays.size());
  std::vector<Hit> hits(rays.size());
  cpu.tracer->cast(rays, hits);
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto a = expected.of(i), b = found.of(i);
    sum.crossings += a.size(), sum.most = std::max(sum.most, a.size()), ++sum.rays;
    for (size_t k = 1; k < b.size(); ++k) {
      ASSERT_NE(b[k].enters, b[k - 1].enters) << describe(b);
      ASSERT_GE(b[k].distance, b[k - 1].distance) << describe(b);
    }
    if (!same_crossings(rays[i], a, b)) {
      ++sum.ambiguous;
      const Vec3 d = rays[i].direction;
      const Vec3 u = normalize(cross(d, std::fabs(d.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
      const Vec3 v = cross(d, u);
      bool is_ambiguous = false, is_known = same_sequence(a, b);
      std::string answers;
      for (int k = 0; k < 8; ++k) {
        const double turn = 0.3 + k * std::numbers::pi / 4;
        Ray beside = rays[i];
        beside.origin += (u * std::cos(turn) + v * std::sin(turn)) * 1e-5;
        RayCrossings look;
        oracle->cast_through({&beside, 1}, look);
        is_ambiguous |= !same_sequence(a, look.of(0));
        is_known |= same_sequence(b, look.of(0));
        answers += "\n or" + describe(look.of(0));
      }
      EXPECT_TRUE(is_ambiguous && is_known)
          << fmt::format(
                 "ray {}: from ({:.17g}, {:.17g}, {:.17g}) along ({:.17g}, {:.17g}, {:.17g})", i,
                 rays[i].origin.x, rays[i].origin.y, rays[i].origin.z, d.x, d.y, d.z)
          << "\ncpu   " << describe(b) << "\noracle" << describe(a) << answers;
      continue;
    }
    // The first is what cast() sees.
    EXPECT_EQ(hits[i].hit(), !b.empty());
    if (b.empty() || !hits[i].hit()) continue;
    EXPECT_EQ(hits[i].id, b[0].id);
    EXPECT_EQ(hits[i].distance, float(b[0].distance));
  }
}

Verdict compare_trees(int first, int last, bool coincident) {
  Verdict sum;
  for (int seed = first; seed < last; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    RandomTreeOptions options;
    options.primitives = 4 + seed % 24;
    options.coincident = coincident;
    options.halfspaces = seed % 5 == 0;
    const Model model = model_of(random_tree(uint64_t(seed), options));
    const std::vector<Ray> rays = random_rays(uint64_t(seed), 300);
    const uint32_t leaf_sizes[] = {2, kAutoLeafSize, 16};
    compare(model, leaf_sizes[seed % 3], rays, sum);
  }
  return sum;
}

TEST(CrossingsAgreement, RandomTrees) {
  const Verdict sum = compare_trees(1, 401, false);
  EXPECT_GT(sum.crossings, sum.rays / 3);
  EXPECT_GE(sum.most, 8u);
  EXPECT_LT(sum.ambiguous, sum.rays / 1000);
}

TEST(CrossingsAgreement, RandomTreesOnAGrid) {
  const Verdict sum = compare_trees(1, 401, true);
  EXPECT_GT(sum.crossings, sum.rays / 3);
  EXPECT_LT(sum.ambiguous, sum.rays / 1000);
}

TEST(CrossingsAgreement, Zoo) {
  Verdict sum;
  for (const ZooScene& scene : zoo()) {
    SCOPED_TRACE(scene.name);
    const Model model = model_of(scene.text, scene.name);
    std::vector<Ray> rays;
    for (const KnownRay& ray : scene.rays) rays.push_back({ray.eye, normalize(ray.direction), 0});
    compare(model, kAutoLeafSize, rays, sum);
  }
  EXPECT_GT(sum.rays, 50u);
}

}  // namespace
}  // namespace whittle

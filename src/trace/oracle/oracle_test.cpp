#include "trace/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"

namespace whittle {
namespace {

/// The hit of one ray through a model given as text.
Hit look(const std::string& text, Vec3 eye, Vec3 direction) {
  const Model model = model_of(text);
  const auto oracle = make_oracle_tracer(model, 1);
  return trace_one(*oracle, eye, direction);
}

TEST(Oracle, SeesWhatPaperSays) {
  for (const ZooScene& scene : zoo()) {
    const Model model = model_of(scene.text, scene.name);
    const auto oracle = make_oracle_tracer(model, 1);
    for (size_t i = 0; i < scene.rays.size(); ++i) {
      SCOPED_TRACE(scene.name + ", ray " + std::to_string(i));
      const KnownRay& ray = scene.rays[i];
      const Hit hit = trace_one(*oracle, ray.eye, ray.direction);
      EXPECT_EQ(hit.id, ray.id);
      if (ray.id == 0 || hit.id == 0) continue;
      EXPECT_NEAR(double(hit.distance), ray.distance, 2e-7 * ray.distance);
      const Vec3 n = normalize(ray.normal), seen = to_double(hit.normal);
      EXPECT_LT(length(seen - n), 1e-6) << seen.x << ' ' << seen.y << ' ' << seen.z << " is not "
                                        << n.x << ' ' << n.y << ' ' << n.z;
    }
  }
}

TEST(Oracle, ZooNamesAreUnique) {
  std::vector<std::string> names;
  for (const ZooScene& scene : zoo()) names.push_back(scene.name);
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(Oracle, EmptyModelsShowNothing) {
  for (const char* text : {"", "group();", "%cube(10);", "intersection() {}", "sphere(r = -1);",
                           "multmatrix([[1,0,0,0],[0,0,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); }"})
    EXPECT_FALSE(look(text, {0.5, 0.5, 9}, {0, 0, -1}).hit()) << text;
}

TEST(Oracle, IdsCountEveryStatement) {
  const std::string text =
      "*cube(1); %cube(1); sphere(r = -1);\n"
      "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]) { cube(1); }\n"
      "cube(1);";
  EXPECT_EQ(look(text, {0.5, 0.5, 9}, {0, 0, -1}).id, 4u);
  EXPECT_EQ(look(text, {0.5, 0.5, -9}, {0, 0, 1}).id, 5u);
}

TEST(Oracle, OrthographicRaysStartBehindTheEyePlane) {
  const Model model = model_of("sphere($fn = 0, r = 5);");
  const auto oracle = make_oracle_tracer(model, 1);
  Camera camera = camera_along({0, 0, 0}, {0, 1, 0});
  camera.orthographic = true;
  camera.ortho_reach = 100;
  EXPECT_NEAR(oracle->render(camera).at(0, 0).distance, -5, 1e-6);
  camera.ortho_reach = 1;
  EXPECT_NEAR(oracle->render(camera).at(0, 0).distance, 5, 1e-6) << "it starts inside";
}

TEST(Oracle, UnboundedIsSeenInsideItsRegionOnly) {
  // The feet are the origin and (0, 0, 8): the region reaches 4000 to all sides of (0, 0, 4).
  const std::string slab =
      "intersection() { halfspace(n = [0, 0, 1], d = 8); "
      "halfspace(n = [0, 0, -1], d = 0); }";
  EXPECT_EQ(look(slab, {3000, 0, 50}, {0, 0, -1}).id, 1u);
  EXPECT_FALSE(look(slab, {5000, 0, 50}, {0, 0, -1}).hit());
  EXPECT_FALSE(look(slab, {-5000, 0, 4}, {1, 0, 0}).hit()) << "the region's sides are no surface";
  // It comes into the region inside the slab and leaves the slab at z = 8, x = 0.
  const Hit hit = look(slab, {-6000, 0, 2}, {1, 0, 0.001});
  EXPECT_EQ(hit.id, 1u);
  EXPECT_NEAR(hit.distance, 6000 * std::sqrt(1 + 1e-6), 1e-2);
  EXPECT_EQ(hit.normal, (Vec3f{0, 0, 1}));
  // It would leave the slab beyond the region.
  EXPECT_FALSE(look(slab, {-6000, 0, 2}, {1, 0, 0.0001}).hit());
  // It enters the slab before the region, and leaves it below inside the region.
  const Hit below = look(slab, {-6000, 0, 20}, {1, 0, -0.008});
  EXPECT_EQ(below.id, 2u);
  EXPECT_NEAR(below.distance, 2500 * std::sqrt(1 + 6.4e-5), 1e-2);
}

TEST(Oracle, OneThreadSeesWhatManySee) {
  const Model model = model_of(random_tree(7, {.primitives = 20}));
  const auto one = make_oracle_tracer(model, 1), many = make_oracle_tracer(model, 4);
  const Camera camera = cameras_for(model, 40, 30)[0];
  const Frame a = one->render(camera), b = many->render(camera), again = many->render(camera);
  const auto same = [](const Hit& x, const Hit& y) {
    return x.id == y.id && x.distance == y.distance && x.normal == y.normal;
  };
  EXPECT_TRUE(std::ranges::equal(a.hits, b.hits, same));
  EXPECT_TRUE(std::ranges::equal(b.hits, again.hits, same));
}

TEST(Oracle, ProbesWhatItRenders) {
  const Model model = model_of(random_tree(8));
  const auto oracle = make_oracle_tracer(model, 2);
  const Camera camera = cameras_for(model, 20, 15)[1];
  const Frame frame = oracle->render(camera);
  std::vector<PixelPosition> positions;
  for (int i = 0; i < 20 * 15; ++i)
    positions.push_back({float(i % 20) + 0.5f, float(i / 20) + 0.5f});
  std::vector<Hit> hits(positions.size());
  oracle->probe(camera, positions, hits);
  for (size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].id, frame.hits[i].id);
    EXPECT_EQ(hits[i].distance, frame.hits[i].distance);
  }
}

TEST(Oracle, TellsItsProgress) {
  const Model model = model_of("cube(1);");
  const auto oracle = make_oracle_tracer(model, 1);
  std::vector<double> told;
  const Progress tell = [&](double share) { told.push_back(share); };
  oracle->render(cameras_for(model, 10, 50)[0], {.progress = tell});
  ASSERT_FALSE(told.empty());
  EXPECT_GT(told.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1);
}

TEST(Oracle, MissesHaveNoFacts) {
  const Hit hit = look("cube(1);", {5, 5, 5}, {0, 0, 1});
  EXPECT_FALSE(hit.hit());
  EXPECT_EQ(hit.distance, std::numeric_limits<float>::infinity());
  EXPECT_EQ(hit.normal, Vec3f{});
}

TEST(Oracle, TenThousandDeepAndAHundredThousandWide) {
  std::string deep, wide = "difference() { cube(10);";
  for (int i = 0; i < 10000; ++i) deep += i % 2 ? "difference() {" : "intersection() {";
  deep += "cube(10);" + std::string(10000, '}');
  for (int i = 0; i < 100000; ++i) wide += "cube(size = [1, 1, 9.5], center = false);";
  EXPECT_EQ(look(deep, {5, 5, 20}, {0, 0, -1}).distance, 10.0f);
  EXPECT_EQ(look(wide + "}", {0.5, 0.5, -20}, {0, 0, 1}).distance, 29.5f);
}

}  // namespace
}  // namespace whittle

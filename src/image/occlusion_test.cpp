// Ambient occlusion where it is known: a ball on a plane, and a floor before a wall.
#include "image/occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "image/scene_for_test.h"

namespace whittle {
namespace {

const Workers kOcclusionThreads(0);
constexpr OcclusionSettings kGood{.reach = kInfinity, .rays = 1, .step = 4};
constexpr OcclusionSettings kBest{.reach = kInfinity, .rays = 16, .step = 1};

std::vector<float> openness_of(SceneForTest& scene, const Camera& camera, const Frame& frame,
                               const OcclusionSettings& settings, const Workers& workers) {
  return openness(scene, camera, frame, settings, workers);
}

/// The farthest that pixels lie from what is known of their points; those that are not looked at
/// have nothing known (NaN).
double worst_error(SceneForTest& scene, const Camera& camera, const OcclusionSettings& settings,
                   const std::function<double(Vec3, uint32_t)>& known) {
  const Frame frame = scene.render(camera);
  const std::vector<float> open = openness_of(scene, camera, frame, settings, kOcclusionThreads);
  double worst = 0;
  size_t count = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Hit& hit = frame.at(x, y);
      if (!hit.hit()) continue;
      const Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double right = known(ray.origin + ray.direction * double(hit.distance), hit.id);
      if (std::isnan(right)) continue;
      worst = std::max(worst, std::fabs(double(open[size_t(y * frame.width + x)]) - right));
      ++count;
    }
  }
  EXPECT_GT(count, 1000u);
  return worst;
}

/// The share of a plane's surroundings that a ball on it hides, r from its foot for a radius of 1:
/// the form factor of a ball that stands above the horizon, cos / distance^2.
double open_beside_ball(double r) {
  return 1 - std::pow(1 + r * r, -1.5);
}

TEST(Occlusion, ABallOnAPlane) {
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_ball({0, 0, 1}, 1);
  const auto known = [](Vec3 p, uint32_t id) {
    const double r = std::hypot(p.x, p.y);
    // The mean over a block of pixels is not what is in its middle where that changes fast.
    return id == 1 && r > 1.3 ? open_beside_ball(r) : std::nan("");
  };
  EXPECT_LT(worst_error(scene, camera_from_above(800, 8), kGood, known), 0.06);
  EXPECT_LT(worst_error(scene, camera_from_above(400, 8), kBest, known), 0.015);
}

TEST(Occlusion, AFloorBeforeAWall) {
  // The plane x = 0, as high as 2, and nothing above: seen from d before it, its share is
  // (1 - d / sqrt(d^2 + 4)) / 2.
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_wall(2);
  const auto known = [](Vec3 p, uint32_t id) {
    return id == 1 && p.x > 0.2 ? 1 - (1 - p.x / std::hypot(p.x, 2)) / 2 : std::nan("");
  };
  EXPECT_LT(worst_error(scene, camera_from_above(800, 8), kGood, known), 0.06);
  EXPECT_LT(worst_error(scene, camera_from_above(400, 8), kBest, known), 0.015);
}

TEST(Occlusion, ACornerOfABox) {
  // A floor between two walls that meet at the origin, 2 high and long without end.
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_box({{-1, -1, 0}, {0, 1e6, 2}});
  scene.add_box({{-1, -1, 0}, {1e6, 0, 2}});
  // The form factor of a wall at distance d, which ends `beside` away on one side: two rectangles
  // that are square to what sees them (Howell, A catalog of radiation heat transfer configuration
  // factors, B-4).
  const auto hidden_by_wall = [](double d, double beside) {
    const double r = std::hypot(d, 2), right = std::numbers::pi / 2;
    return (std::atan(beside / d) + right - d / r * (std::atan(beside / r) + right)) /
           (2 * std::numbers::pi);
  };
  const auto known = [&](Vec3 p, uint32_t id) {
    return id == 1 && p.x > 0.3 && p.y > 0.3
               ? 1 - hidden_by_wall(p.x, p.y) - hidden_by_wall(p.y, p.x)
               : std::nan("");
  };
  EXPECT_LT(worst_error(scene, camera_from_above(800, 8), kGood, known), 0.06);
  EXPECT_LT(worst_error(scene, camera_from_above(400, 8), kBest, known), 0.015);
}

TEST(Occlusion, ReachesNoFartherThanItIsAsked) {
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_ball({0, 0, 1}, 1);
  OcclusionSettings near = kGood;
  near.reach = 1;
  // A point more than 1 before the ball's side sees nothing of it.
  const auto known = [](Vec3 p, uint32_t id) {
    return id == 1 && std::hypot(p.x, p.y) > std::sqrt(3.0) + 0.4 ? 1.0 : std::nan("");
  };
  EXPECT_LT(worst_error(scene, camera_from_above(800, 8), near, known), 1e-6);
  EXPECT_EQ(hidden_share({0.5f, 1, {}}, 1), 0.5625);
  EXPECT_EQ(hidden_share({2, 1, {}}, 1), 0);
  EXPECT_EQ(hidden_share({2, 1, {}}, kInfinity), 1);
  EXPECT_EQ(hidden_share({}, kInfinity), 0);
}

TEST(Occlusion, IsTheSameOnAnyNumberOfThreads) {
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_ball({0, 0, 1}, 1);
  scene.add_ball({1.5, 0.5, 0.4}, 0.4);
  const Camera camera = camera_from_above(131, 8);
  const Frame frame = scene.render(camera);
  for (const OcclusionSettings& settings : {kGood, kBest}) {
    const std::vector<float> expected = openness_of(scene, camera, frame, settings, Workers(1));
    for (const int threads : {2, 3, 7})
      EXPECT_EQ(openness_of(scene, camera, frame, settings, Workers(threads)), expected);
  }
}

TEST(Occlusion, FacesTooNarrowForTheLatticeSendRaysFromEveryPixel) {
  // A fin that is one pixel wide, on an odd column: the lattice misses it.
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_box({{0.04, -2, 0}, {0.08, 2, 1}});
  const Camera camera = camera_from_above(200, 8);
  const Frame frame = scene.render(camera);
  ASSERT_EQ(frame.at(101, 100).id, 2u);
  ASSERT_NE(frame.at(100, 100).id, 2u);
  const std::vector<float> open = openness_of(scene, camera, frame, kGood, kOcclusionThreads);
  EXPECT_FLOAT_EQ(open[size_t(100 * 200 + 101)], 1);
  EXPECT_LT(open[size_t(100 * 200 + 97)], 0.75f) << "the floor beside it";
}

}  // namespace
}  // namespace whittle

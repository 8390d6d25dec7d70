#include "trace/closeness.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

/// A wall at y = `at`.
class FlatWall : public Tracer {
 public:
  explicit FlatWall(float at) : at_(at) {}
  const char* name() const override { return "wall"; }
  Frame render(const Camera&, const RenderControl&) override { return {}; }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for (size_t i = 0; i < positions.size(); ++i) {
      const Ray ray = camera.ray(positions[i].x, positions[i].y);
      hits[i] = {};
      if (at_ > 0) hits[i] = {float(at_ / ray.direction.y), 1, {0, -1, 0}};
    }
  }
  void cast(std::span<const Ray>, std::span<Hit>) override {}

 private:
  float at_;
};

const Box kRegion{{-50, 0, -50}, {50, 100, 50}};

TEST(Closeness, IsThePixelsOfThatWhichFillsThePicture) {
  // 100 across at a distance of 200, where the picture is 100 across.
  const Camera camera{.eye = {0, -200, 0}, .half_height = 0.25, .width = 64, .height = 64};
  EXPECT_NEAR(rays_at_most(camera, kRegion), 64 * 64, 1e-6);
  FlatWall near(200), far(400), nothing(0);
  EXPECT_NEAR(rays_at_nearest_hit(near, camera, kRegion), 64 * 64, 64);
  EXPECT_NEAR(rays_at_nearest_hit(far, camera, kRegion), 64 * 64 / 4.0, 16);
  EXPECT_EQ(rays_at_nearest_hit(nothing, camera, kRegion), 0);
}

TEST(Closeness, HasNoBoundForAnEyeAmongThings) {
  const Camera camera{.eye = {0, 10, 0}, .half_height = 0.25, .width = 64, .height = 64};
  EXPECT_EQ(rays_at_most(camera, kRegion), kInfinity);
  FlatWall wall(2);
  EXPECT_NEAR(rays_at_nearest_hit(wall, camera, kRegion), 64 * 64 * 1e4, 64 * 1e4);
  EXPECT_EQ(rays_at_most(camera, Box{}), 0);
}

TEST(Closeness, IsTheSameEverywhereForParallelRays) {
  const Camera camera{.eye = {0, 10, 0},
                      .orthographic = true,
                      .half_height = 5,
                      .ortho_reach = 1000,
                      .width = 64,
                      .height = 64};
  EXPECT_NEAR(rays_at_most(camera, kRegion), 64 * 64 * 100, 1e-6);
  FlatWall wall(2);
  EXPECT_NEAR(rays_at_nearest_hit(wall, camera, kRegion), 64 * 64 * 100, 1e-6);
}

}  // namespace
}  // namespace whittle

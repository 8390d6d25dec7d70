#include "image/xray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "image/srgb.h"

namespace whittle {
namespace {

/// Walls one behind the other, where the ray's x is on their side of a limit.
class Walls final : public Tracer {
 public:
  const char* name() const override { return "walls"; }
  Frame render(const Camera&, const RenderControl&) override { return {}; }
  void probe(const Camera&, std::span<const PixelPosition>, std::span<Hit>) override {}
  void cast(std::span<const Ray>, std::span<Hit>) override {}
  void cast_through(std::span<const Ray> rays, RayCrossings& found) override {
    found = {};
    for (const Ray& ray : rays) {
      for (const SurfaceCrossing& wall : walls)
        if (ray.origin.x < limit) found.all.push_back(wall);
      found.ends.push_back(found.all.size());
    }
  }

  std::vector<SurfaceCrossing> walls;
  double limit = kInfinity;
};

/// From above, one unit a pixel; x is 0 at the picture's middle.
Camera from_above(int width, int height) {
  Camera camera;
  camera.eye = {0, 0, 10};
  camera.right = {1, 0, 0}, camera.up = {0, 1, 0}, camera.forward = {0, 0, -1};
  camera.orthographic = true;
  camera.width = width, camera.height = height;
  camera.half_height = height / 2.0;
  return camera;
}

TEST(Xray, OpacityFollowsBeerAndLambert) {
  EXPECT_FLOAT_EQ(xray_opacity(1), float(1 - std::exp(-kXrayThickness)));
  EXPECT_FLOAT_EQ(xray_opacity(0.5), float(1 - std::exp(-2 * kXrayThickness)));
  EXPECT_EQ(xray_opacity(0), 1);
  // Two films hold back what one of twice the thickness does.
  const float through = 1 - xray_opacity(1);
  EXPECT_NEAR(through * through, 1 - xray_opacity(0.5), 1e-6);
}

TEST(Xray, WallsAreBlendedInTheirOrder) {
  Walls walls;
  const double slanted = std::sqrt(0.75);
  walls.walls = {{1, 1, true, {0, 0, 1}}, {2, 2, false, {slanted, 0, -0.5}}};
  const std::vector<Appearance> looks{{}, {{1, 0, 0, 1}, false}, {{0, 1, 0, 1}, false}};
  ShadeSettings settings;
  settings.background = false;
  const Picture picture = xray_picture(walls, from_above(3, 2), looks, settings, 3, Workers(2));
  const float first = xray_opacity(1), second = (1 - first) * xray_opacity(0.5);
  const float alpha = first + second;
  for (size_t i = 0; i < picture.rgba.size(); i += 4) {
    EXPECT_NEAR(picture.rgba[i], 255 * srgb_from_linear(kXrayInk * first / alpha), 0.6);
    EXPECT_NEAR(picture.rgba[i + 1], 255 * srgb_from_linear(kXrayInk * second / alpha), 0.6);
    EXPECT_EQ(picture.rgba[i + 2], 0);
    EXPECT_NEAR(picture.rgba[i + 3], 255 * alpha, 0.6);
  }
}

TEST(Xray, EdgesAreTheShareOfEachSide) {
  Walls walls;
  walls.walls = {{1, 1, true, {0, 0, 1}}, {2, 1, false, {0, 0, -1}}};
  walls.limit = 0.25;  // a quarter of the third pixel of five is right of its middle
  ShadeSettings settings;
  settings.background = false;
  const std::vector<Appearance> looks(2);
  const Picture picture = xray_picture(walls, from_above(5, 1), looks, settings, 4, Workers(1));
  const double alpha = 1 - std::exp(-2 * kXrayThickness);
  EXPECT_NEAR(picture.rgba[3], 255 * alpha, 0.6);
  EXPECT_NEAR(picture.rgba[4 * 2 + 3], 255 * alpha * 0.75, 0.6);
  EXPECT_EQ(picture.rgba[4 * 4 + 3], 0);
}

TEST(Xray, IsTheSameOnAnyNumberOfThreads) {
  Walls walls;
  walls.walls = {{1, 1, true, {0, 0, 1}}, {2, 1, false, {0, 0, -1}}};
  walls.limit = 3.3;
  const std::vector<Appearance> looks(2);
  const Camera camera = from_above(40, 30);
  EXPECT_EQ(xray_picture(walls, camera, looks, {}, 3, Workers(1)).rgba,
            xray_picture(walls, camera, looks, {}, 3, Workers(4)).rgba);
}

}  // namespace
}  // namespace whittle

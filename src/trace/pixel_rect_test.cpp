#include "trace/pixel_rect.h"

#include <gtest/gtest.h>

#include <random>

namespace whittle {
namespace {

bool meets(const Box& box, const Ray& ray) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis],
                 b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

TEST(PixelRect, HoldsEveryPixelThatMeetsTheBox) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vec = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  int partial = 0;
  for (int i = 0; i < 2000; ++i) {
    Camera camera;
    camera.width = 40, camera.height = 24;
    camera.eye = vec() * 4.0;
    camera.forward = normalize(vec());
    camera.right = normalize(cross(camera.forward, vec()));
    camera.up = cross(camera.right, camera.forward);
    camera.orthographic = i % 2;
    camera.half_height = 0.2 + std::fabs(unit(random));
    camera.ortho_reach = 100;
    Box box;
    box.include(vec() * 2.0);
    box.include(vec() * 2.0);
    const PixelRect rect = pixels_covering(camera, box);
    partial += rect.width() < camera.width && rect.width() > 0;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        if (meets(box, camera.ray(x + 0.5, y + 0.5))) {
          ASSERT_TRUE(rect.x0 <= x && x < rect.x1 && rect.y0 <= y && y < rect.y1) << i;
        }
  }
  EXPECT_GT(partial, 200);
}

TEST(PixelRect, IsTightForABoxAhead) {
  Camera camera;  // at the origin, looking along y; tan(fov / 2) = 1
  camera.width = camera.height = 100;
  const PixelRect rect = pixels_covering(camera, {{-1, 10, -1}, {1, 12, 1}});
  EXPECT_EQ(rect.x0, 44);
  EXPECT_EQ(rect.x1, 56);
  EXPECT_EQ(rect.y0, 44);
  EXPECT_EQ(rect.y1, 56);
}

}  // namespace
}  // namespace whittle

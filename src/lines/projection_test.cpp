#include "lines/projection.h"

#include <gtest/gtest.h>

#include "trace/view_for_test.h"

namespace whittle {
namespace {

Camera camera(bool orthographic) {
  ViewOptions view;
  view.width = 320, view.height = 200;
  view.orthographic = orthographic;
  return make_camera(view_of({1, 2, 3, 55, 10, 25, 40}, view), {}, {});
}

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_LT(length(a - b), tolerance);
}

TEST(ViewProjection, IsTheCamerasPicture) {
  const Camera eye = camera(false);
  const ViewProjection projection(eye, 1, 10);
  const Vec3 from{0, 1, 2}, to{3, 2, 5};
  const DrawnLine line = *projection.draw(from, to);
  for (const double s : {0.0, 0.25, 1.0}) {
    const Vec3 point = projection.point(line, s);
    // On the line in space, and on the camera's ray.
    expect_near(cross(point - from, to - from), {}, 1e-12);
    const Vec2 at = line.at(s);
    expect_near(cross(eye.ray(at.x, at.y).direction, normalize(point - eye.eye)), {}, 1e-12);
    double distance = 0;
    const Ray ray = projection.ray_to(point, distance);
    expect_near(ray.origin + ray.direction * distance, point, 1e-12);
  }
}

TEST(ViewProjection, ClipsBehindTheEyeAndBesideTheFrame) {
  const Camera eye = camera(false);
  const ViewProjection projection(eye, 1, 10);
  const Vec3 before = eye.eye + eye.forward * 10, behind = eye.eye - eye.forward * 10;
  EXPECT_FALSE(projection.draw(behind, behind + eye.right));
  EXPECT_FALSE(projection.draw(before + eye.right * 20, before + eye.right * 30));
  for (const auto& [a, b] : {std::pair(before + eye.up, behind + eye.right),
                             std::pair(before - eye.right * 50, before + eye.right * 50)}) {
    const std::optional<DrawnLine> line = projection.draw(a, b);
    ASSERT_TRUE(line);
    for (const Vec2 p : {line->a, line->b}) {
      EXPECT_GT(p.x, -5);
      EXPECT_LT(p.x, 325);
      EXPECT_GT(p.y, -5);
      EXPECT_LT(p.y, 205);
    }
    expect_near(cross(line->from - a, b - a), {}, 1e-9);
  }
}

TEST(ViewProjection, OrthographicIsToScale) {
  const Camera eye = camera(true);
  const ViewProjection projection(eye, 2, 10);
  const DrawnLine line =
      *projection.draw(eye.eye + eye.right * 3, eye.eye + eye.up * 5 + eye.forward * 7);
  EXPECT_NEAR(line.a.x, 6, 1e-12);
  EXPECT_NEAR(line.a.y, 0, 1e-12);
  EXPECT_NEAR(line.b.y, -10, 1e-12);
  EXPECT_TRUE(projection.is_before(line.key_a, line.key_b));
  EXPECT_FALSE(projection.is_before(line.key_b, line.key_a));
}

}  // namespace
}  // namespace whittle

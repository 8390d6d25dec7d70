// Unusual eyes and unusual shapes: fields of view near nothing and near half of everything, flat
// ellipsoids, and the horizon of a very large ball.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "agreement/cpu_subject.h"
#include "numbers/accuracy.h"
#include "support/read_text.h"

namespace whittle {
namespace {

TEST(Views, FieldsOfViewFromAThousandthToAlmostHalfATurn) {
  const std::string text =
      "difference() { cube(10, center = true); sphere(6); }"
      "translate([0, 0, 9]) cylinder(h = 3, r = 2);";
  const Answer answer = [](const ExactRay& ray) {
    const Known cut =
        seen_of_difference(ray, {box(1, ray, {-5, -5, -5}, {5, 5, 5}), sphere(2, ray, {}, 6)});
    const Known top = seen_of_union(ray, {cylinder(3, ray, 2, {0, 0, 9}, 2, 3)});
    return top.distance < cut.distance ? top : cut;
  };
  for (const double fov : {0.001, 0.1, 1.0, 60.0, 120.0, 170.0, 179.0}) {
    SCOPED_TRACE(fov);
    // As far as the field of view asks for, and from the middle of the hollow.
    const double away = 9 / std::tan(fov * std::atan(1.0) / 90);
    const Vec3 from = normalize(Vec3{0.57, -0.74, 0.43});
    const PictureCounts outside =
        expect_known(text, look(from * std::max(away, 8.7), {0, 0, 2}, fov, 65, 49), answer);
    EXPECT_GT(outside.hits, fov > 100 ? 0 : outside.pixels / 10);
    expect_known(text, look({0.5, 0.25, -0.125}, from * 9, fov), answer);
  }
}

TEST(Views, FlatAndNeedleLikeEllipsoids) {
  // Semi-axes; the sphere and the scale are read as doubles, so these are exact.
  const Vec3 shapes[] = {{1, 1, 1e-3},    {1, 1, 1e-6},   {1e-3, 1e-3, 1},
                         {1e-6, 1e-6, 1}, {1e3, 1, 1e-3}, {1e6, 1, 1}};
  for (const Vec3 s : shapes) {
    SCOPED_TRACE(fmt::format("{} x {} x {}", s.x, s.y, s.z));
    const std::string text = fmt::format("scale([{}, {}, {}]) sphere(1);", s.x, s.y, s.z);
    const Answer answer = [&](const ExactRay& ray) {
      return seen_of_union(ray, {ellipsoid(1, ray, {}, exact(s))});
    };
    const double large = max_component(s);
    const double small = std::min({s.x, s.y, s.z});
    int hits = 0;
    for (const Vec3 from : {Vec3{3, -4, 2}, Vec3{0, -5, 0}, Vec3{0.01, -5, 1e-4}, Vec3{0, 0, 5}}) {
      hits += expect_known(text, look(from * large, {}, 30), answer).hits;
      hits += expect_known(text, look_parallel(from * large, {}, 3 * large), answer).hits;
      // The end of each axis, as near as it is thin.
      for (const Vec3 end : {Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}})
        hits += expect_known(text, look_parallel(end + from * large, end, 8 * small), answer).hits;
    }
    EXPECT_GT(hits, 64 * 48);
  }
}

TEST(Views, TheHorizonOfABallOfAThousandKilometres) {
  constexpr double kRadius = 1e6, kHeight = 2;
  const std::string ball = "translate([0, 0, -1e6]) sphere(1e6);";
  const Answer answer = [](const ExactRay& ray) {
    return seen_of_union(ray, {sphere(1, ray, {0, 0, -kRadius}, kRadius)});
  };
  // The horizon lies asin(R / (R + h)) from straight down: 0.002 below level.
  const double dip = std::acos(kRadius / (kRadius + kHeight));
  for (const double fov : {60.0, 1.0, 0.01, 0.0001}) {
    SCOPED_TRACE(fov);
    const Vec3 eye = {0, 0, kHeight};
    const Vec3 ahead = {std::sin(0.7) * std::cos(dip), std::cos(0.7) * std::cos(dip),
                        -std::sin(dip)};
    const PictureCounts counts =
        expect_known(ball, look(eye, eye + ahead * 100.0, fov, 128, 96), answer);
    EXPECT_NEAR(counts.hits, counts.pixels / 2, counts.pixels / 50);
    EXPECT_EQ(counts.undecided, 0);
  }

  // In a large picture every column is background down to the horizon and ball below it.
  const Model model = model_of(ball);
  CpuSubject cpu(model, {});
  const Camera camera = look({0, 0, kHeight}, {100, 30, kHeight - 0.2}, 60, 1024, 768);
  const Frame frame = cpu.tracer->render(camera, {});
  for (int x = 0; x < camera.width; ++x) {
    int horizon = camera.height;
    for (int y = 0; y < camera.height; ++y) {
      const ExactRay ray = exact_ray(camera, x + 0.5L, y + 0.5L);
      const bool below = ray.direction.z < -std::sin(Exact(dip));
      if (below && y < horizon) horizon = y;
    }
    for (int y = 0; y < camera.height; ++y)
      ASSERT_EQ(frame.at(x, y).hit(), y >= horizon) << "column " << x << ", row " << y;
  }
}

}  // namespace
}  // namespace whittle

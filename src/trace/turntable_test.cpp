#include "trace/turntable.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whittle {
namespace {

void expect_at(Vec3 a, Vec3 b, double within = 1e-12) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], within) << k;
}

TEST(Turntable, AQuarterTurnGoesFromFrontToRight) {
  Camera front;
  front.eye = {1, -10, 3};
  const Camera right = turned(front, {1, 2, 0}, 90);
  expect_at(right.eye, {13, 2, 3});
  expect_at(right.forward, {-1, 0, 0});
  expect_at(right.right, {0, 1, 0});
  expect_at(right.up, {0, 0, 1});
  EXPECT_EQ(turned(front, {1, 2, 0}, 0), front);
}

TEST(Turntable, FramesDivideOneTurn) {
  Turntable table;
  table.first.eye = {0, -5, 1};
  EXPECT_EQ(table.at(0, 7), table.first);
  const Camera half = table.at(4, 8);
  expect_at(half.eye, {0, 5, 1});
}

TEST(Turntable, ABoxSweepsACylinder) {
  const Box box{{1, -2, 3}, {5, 6, 7}};
  const Reach solid = [&](const Directions& directions) { return box_reach(box, directions); };
  const Vec3 axis = box.center();
  const Reach swept = swept_reach(solid, axis);
  const double radius = std::hypot(2, 4);
  const std::array<double, 4> found =
      swept({Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 2}, Vec3{3, 4, -1}});
  const std::array<double, 4> expected = {axis.x + radius, -axis.y + radius, 14.0,
                                          3 * axis.x + 4 * axis.y + 5 * radius - 3};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_GE(found[i], expected[i] - 1e-9) << i;
    EXPECT_LE(found[i], expected[i] + 0.005 * 5 * radius) << i;
  }
}

TEST(NamedViews, LookWhereTheirNamesSay) {
  struct Case {
    NamedView view;
    Vec3 forward, up;
  };
  for (const Case& c :
       {Case{NamedView::kFront, {0, 1, 0}, {0, 0, 1}},
        Case{NamedView::kBack, {0, -1, 0}, {0, 0, 1}}, Case{NamedView::kLeft, {1, 0, 0}, {0, 0, 1}},
        Case{NamedView::kRight, {-1, 0, 0}, {0, 0, 1}},
        Case{NamedView::kTop, {0, 0, -1}, {0, 1, 0}},
        Case{NamedView::kBottom, {0, 0, 1}, {0, -1, 0}}}) {
    ViewOptions options;
    options.named = c.view;
    const Camera camera = make_camera(options, {}, Box{{0, 0, 0}, {1, 2, 3}});
    expect_at(camera.forward, c.forward);
    expect_at(camera.up, c.up);
    // The middle of the box is in the middle of the picture.
    const Vec3 to_middle = Vec3{0.5, 1, 1.5} - camera.eye;
    EXPECT_NEAR(dot(to_middle, camera.right), 0, 1e-12);
    EXPECT_NEAR(dot(to_middle, camera.up), 0, 1e-12);
  }
  ViewOptions options;
  options.named = NamedView::kIso;
  const Camera camera = make_camera(options, {}, Box{{0, 0, 0}, {1, 2, 3}});
  expect_at(camera.forward, Vec3{-1, 1, -1} / std::sqrt(3.0));
}

TEST(NamedViews, AFilesViewDoesNotCountAndACameraIsRefused) {
  ViewOptions options;
  options.named = NamedView::kTop;
  const Box box{{0, 0, 0}, {1, 2, 3}};
  FileView file;
  file.distance = 5;
  file.target = Vec3{9, 9, 9};
  EXPECT_EQ(make_camera(options, file, box), make_camera(options, {}, box));
  EXPECT_TRUE(gives_camera(options));
  EXPECT_TRUE(check_view(options));
  options.distance = 5;
  const Status refused = check_view(options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace whittle

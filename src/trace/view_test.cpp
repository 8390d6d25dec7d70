#include "trace/view.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "trace/view_for_test.h"

namespace whittle {
namespace {

bool hits(const Ray& ray, const Box& box) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0) {
      if (ray.origin[k] < box.lo[k] || ray.origin[k] > box.hi[k]) return false;
      continue;
    }
    const double a = (box.lo[k] - ray.origin[k]) / ray.direction[k];
    const double b = (box.hi[k] - ray.origin[k]) / ray.direction[k];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

/// The pixels whose centre ray meets the box: how many, and the rectangle that holds them.
struct Silhouette {
  int count = 0, x0 = 1 << 20, x1 = -1, y0 = 1 << 20, y1 = -1;
  int columns() const { return x1 - x0 + 1; }
  int rows() const { return y1 - y0 + 1; }
};

Silhouette silhouette(const Camera& camera, const Box& box) {
  Silhouette s;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (!hits(camera.ray(x + 0.5, y + 0.5), box)) continue;
      ++s.count;
      s.x0 = std::min(s.x0, x), s.x1 = std::max(s.x1, x);
      s.y0 = std::min(s.y0, y), s.y1 = std::max(s.y1, y);
    }
  }
  return s;
}

ViewOptions sized(int width, int height) {
  ViewOptions options;
  options.width = width;
  options.height = height;
  return options;
}

Camera camera_of(const CameraNumbers& numbers, int width, int height, const Box& box = {},
                 bool orthographic = false) {
  ViewOptions options = view_of(numbers, sized(width, height));
  options.orthographic = orthographic;
  return make_camera(options, {}, box);
}

void expect_near(Vec3 a, Vec3 b, double error = 1e-12) {
  EXPECT_LE(length(a - b), error) << a.x << " " << a.y << " " << a.z << " against " << b.x << " "
                                  << b.y << " " << b.z;
}

const Box kCube10{{-5, -5, -5}, {5, 5, 5}};

TEST(View, PerspectiveCubeSpansWhatOpenscadDraws) {
  const Silhouette s = silhouette(camera_of({0, 0, 0, 0, 0, 0, 50}, 400, 400), kCube10);
  EXPECT_EQ(s.columns(), 224);
  EXPECT_EQ(s.rows(), 224);
  EXPECT_EQ(s.count, 224 * 224);
}

TEST(View, OrthographicCubeSpansWhatOpenscadDraws) {
  const Silhouette s =
      silhouette(camera_of({0, 0, 0, 0, 0, 0, 50}, 400, 200, kCube10, true), kCube10);
  EXPECT_EQ(s.columns(), 100);
  EXPECT_EQ(s.rows(), 100);
}

const Box kBrick{{1, 2, 3}, {11, 8, 7}};

TEST(View, StraightDownHasXToTheRightAndYUp) {
  for (const CameraNumbers& numbers :
       std::vector<CameraNumbers>{{0, 0, 0, 0, 0, 0, 60}, {0, 0, 60, 0, 0, 0}}) {
    const Camera camera = camera_of(numbers, 400, 300);
    expect_near(camera.eye, {0, 0, 60});
    expect_near(camera.right, {1, 0, 0});
    expect_near(camera.up, {0, 1, 0});
    expect_near(camera.forward, {0, 0, -1});
  }
}

TEST(View, StraightUpInVectorFormTurnsByHalf) {
  const Camera camera = camera_of({0, 0, -60, 0, 0, 0}, 400, 300);
  expect_near(camera.right, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.forward, {0, 0, 1});
  const Camera gimbal = camera_of({0, 0, 0, 180, 0, 180, 60}, 400, 300);
  expect_near(gimbal.eye, camera.eye);
  expect_near(gimbal.right, camera.right);
  expect_near(gimbal.up, camera.up);
}

TEST(View, DefaultRotationLooksFromTheFrontRightAbove) {
  const Camera camera = make_camera(sized(64, 64), {}, kCube10);
  EXPECT_GT(camera.eye.x, 0);
  EXPECT_LT(camera.eye.y, 0);
  EXPECT_GT(camera.eye.z, 0);
  EXPECT_GT(camera.up.z, 0);
  EXPECT_EQ(camera.right.z, 0);
}

TEST(View, NothingGivenFitsAndCentres) {
  const Camera camera = make_camera(sized(64, 64), {}, kBrick);
  const double distance = kBrick.diagonal() / 2 / std::sin(11.25 * std::acos(-1.0) / 180);
  expect_near(camera.eye + camera.forward * distance, kBrick.center(), 1e-9);
}

TEST(View, ViewAllWithoutAutoCenterKeepsTheTarget) {
  ViewOptions options = view_of({1, 0, 0, 0, 0, 0, 5}, sized(64, 64));
  options.view_all = true;
  const double radius = length(kBrick.center() - Vec3{1, 0, 0}) + kBrick.diagonal() / 2;
  expect_near(make_camera(options, {}, kBrick).eye,
              {1, 0, radius / std::sin(11.25 * std::acos(-1.0) / 180)}, 1e-9);
}

TEST(View, AutoCenterAloneDoesNothing) {
  ViewOptions options = view_of({1, 0, 0, 0, 0, 0, 5}, sized(64, 64));
  options.auto_center = true;
  expect_near(make_camera(options, {}, kBrick).eye, {1, 0, 5});
}

TEST(View, FileViewReplacesTheFitting) {
  FileView file;
  file.distance = 80;
  const Camera camera = make_camera(sized(64, 64), file, kBrick);
  EXPECT_NEAR(length(camera.eye), 80, 1e-9);
  ViewOptions asked = sized(64, 64);
  asked.view_all = asked.auto_center = true;
  expect_near(make_camera(asked, file, kBrick).eye, camera.eye);
}

TEST(View, FileViewDoesNotCountBesideACamera) {
  FileView file;
  file.distance = 80;
  file.target = Vec3{9, 9, 9};
  file.fov_degrees = 60;
  const Camera camera = make_camera(view_of({0, 0, 0, 0, 0, 0, 50}, sized(64, 64)), file, kBrick);
  expect_near(camera.eye, {0, 0, 50});
  EXPECT_NEAR(camera.half_height, std::tan(11.25 * std::acos(-1.0) / 180), 1e-15);
}

TEST(View, FieldOfViewOfTheFileYieldsToTheOption) {
  FileView file;
  file.fov_degrees = 90;
  EXPECT_NEAR(make_camera(sized(8, 8), file, {}).half_height, 1, 1e-15);
  ViewOptions options = sized(8, 8);
  options.fov_degrees = 2 * std::atan(0.5) * 180 / std::acos(-1.0);
  EXPECT_NEAR(make_camera(options, file, {}).half_height, 0.5, 1e-15);
}

TEST(View, EmptyBoxKeepsTheDefaultView) {
  for (const Box& box : {Box{}, Box::everything(), Box{{0, 0, 0}, {0, 0, 0}}}) {
    const Camera camera = make_camera(sized(64, 64), {}, box);
    EXPECT_NEAR(length(camera.eye), kDefaultDistance, 1e-9);
    EXPECT_TRUE(is_finite(camera.eye));
  }
}

TEST(View, OrthographicRaysStartFarBehindTheEye) {
  const Camera camera = camera_of({0, 0, 0, 90, 0, 0, 50}, 64, 64, {}, true);
  EXPECT_EQ(camera.ray(32, 32).t_min, -5000);
  EXPECT_EQ(camera_of({0, 0, 0, 90, 0, 0, 50}, 64, 64).ray(32, 32).t_min, 0);
}

TEST(View, ANegativeDistanceIsOnlyForViewAllToReplace) {
  ViewOptions options = view_of({-1, -1, -1, 90, 0, 0, -1}, sized(64, 64));
  ASSERT_FALSE(check_view(options));
  EXPECT_EQ(check_view(options).error().kind, ErrorKind::kUsage);
  options.view_all = true;
  EXPECT_TRUE(check_view(options));
  ViewOptions positive = options;
  positive.distance = 1;
  expect_near(make_camera(options, {}, kBrick).eye, make_camera(positive, {}, kBrick).eye);
  // Of nothing there is no distance.
  EXPECT_LT(make_camera(options, {}, {}).eye.y, -1);
}

TEST(View, IsToldInOpenscadsWords) {
  const ViewOptions given = view_of({1, 2, 3, 40, 0, 60, 70}, sized(8, 8));
  const GimbalView same = frame_view(given, {}, {}, {}).view;
  expect_near(same.target, {1, 2, 3});
  expect_near(same.rotation_degrees, {40, 0, 60});
  EXPECT_EQ(same.distance, 70);
  EXPECT_EQ(same.fov_degrees, kDefaultFovDegrees);
  // A camera in the vector form, and the one that looks by its angles.
  for (const CameraNumbers& numbers : std::vector<CameraNumbers>{
           {1, -2, 3, 4, 5, 6}, {0, 0, 9, 0, 0, -9}, {-5, -6, -7, 1, 1, 1}}) {
    const ViewOptions vector = view_of(numbers, sized(8, 8));
    const GimbalView view = frame_view(vector, {}, {}, {}).view;
    ViewOptions angles = sized(8, 8);
    angles.target = view.target;
    angles.rotation_degrees = view.rotation_degrees;
    angles.distance = view.distance;
    const Camera a = make_camera(vector, {}, {}), b = make_camera(angles, {}, {});
    EXPECT_LT(length(a.eye - b.eye), 1e-12) << testing::PrintToString(numbers);
    EXPECT_LT(length(a.right - b.right), 1e-12) << testing::PrintToString(numbers);
    EXPECT_LT(length(a.up - b.up), 1e-12) << testing::PrintToString(numbers);
  }
}

/// Where the corners of a box are seen, as shares of the picture from its middle.
struct Extent {
  double low_x = kInfinity, high_x = -kInfinity, low_y = kInfinity, high_y = -kInfinity;
};
Extent extent_of(const Camera& camera, const Box& box) {
  Extent e;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = box.corner(i) - camera.eye;
    const double scale = camera.orthographic ? 1 : dot(p, camera.forward);
    const double y = dot(p, camera.up) / (scale * 2 * camera.half_height);
    const double x = dot(p, camera.right) / (scale * 2 * camera.half_height) *
                     double(camera.height) / double(camera.width);
    e.low_x = std::min(e.low_x, x), e.high_x = std::max(e.high_x, x);
    e.low_y = std::min(e.low_y, y), e.high_y = std::max(e.high_y, y);
  }
  return e;
}

RC_GTEST_PROP(View, TightFramingFillsItsShareOfTheSideThatIsFilledMost, ()) {
  const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 10.0; };
  ViewOptions options = sized(*rc::gen::inRange(10, 400), *rc::gen::inRange(10, 400));
  options.tight = options.view_all = options.auto_center = true;
  options.orthographic = *rc::gen::arbitrary<bool>();
  options.rotation_degrees = Vec3{number(-1800, 1800), number(-1800, 1800), number(-1800, 1800)};
  options.fov_degrees = number(50, 900);
  const Vec3 low{number(-900, 900), number(-900, 900), number(-900, 900)};
  const Box box{low, low + Vec3{number(1, 500), number(1, 500), number(1, 500)}};
  const Extent e = extent_of(make_camera(options, {}, box), box);
  const double wide = e.high_x - e.low_x, tall = e.high_y - e.low_y;
  RC_ASSERT(std::fabs(std::max(wide, tall) - kTightFill) < 1e-9);
  // The side that is filled most is filled evenly, and nothing is outside on the other.
  RC_ASSERT(std::fabs(wide > tall ? e.high_x + e.low_x : e.high_y + e.low_y) < 1e-9);
  RC_ASSERT(std::max(e.high_x, -e.low_x) < kTightFill / 2 + 1e-9);
  RC_ASSERT(std::max(e.high_y, -e.low_y) < kTightFill / 2 + 1e-9);
}

TEST(View, TightFramingWithoutAutoCenterLooksAtTheTarget) {
  for (const bool orthographic : {false, true}) {
    ViewOptions options = sized(200, 100);
    options.tight = options.view_all = true;
    options.orthographic = orthographic;
    options.target = Vec3{1, 2, 3};
    const Box box{{-5, -5, -5}, {9, 5, 5}};
    const FramedView framed = frame_view(
        options, {}, box, [&](const Directions& directions) { return box_reach(box, directions); });
    const Vec3 to_target = *options.target - framed.camera.eye;
    EXPECT_LT(length(normalize(to_target) - framed.camera.forward), 1e-12);
    const Extent e = extent_of(framed.camera, box);
    const double farthest = std::max(std::max(e.high_x, -e.low_x), std::max(e.high_y, -e.low_y));
    EXPECT_NEAR(farthest, kTightFill / 2, 1e-9);
  }
}

TEST(View, TightFramingIsToldInOpenscadsWordsToo) {
  for (const bool orthographic : {false, true}) {
    ViewOptions options = sized(120, 90);
    options.tight = true;
    options.orthographic = orthographic;
    const Box box{{0, 0, 0}, {30, 20, 10}};
    const FramedView framed = frame_view(
        options, {}, box, [&](const Directions& directions) { return box_reach(box, directions); });
    ViewOptions same = sized(120, 90);
    same.orthographic = orthographic;
    same.target = framed.view.target, same.distance = framed.view.distance;
    same.rotation_degrees = framed.view.rotation_degrees;
    const Camera camera = make_camera(same, {}, {});
    EXPECT_LT(length(camera.eye - framed.camera.eye), 1e-9);
    EXPECT_NEAR(camera.half_height, framed.camera.half_height, 1e-9);
  }
}

TEST(View, OpenscadsFramingIsTheOneThatIsNotTight) {
  const Box box{{0, 0, 0}, {30, 20, 10}};
  const Camera camera = make_camera(sized(100, 100), {}, box);
  EXPECT_NEAR(length(camera.eye - box.center()),
              box.diagonal() / 2 / std::sin(11.25 / 180 * std::acos(-1.0)), 1e-9);
}

RC_GTEST_PROP(View, AxesAreOrthonormalAndRightHanded, ()) {
  const auto angle = [] { return *rc::gen::inRange(-7200, 7200) / 10.0; };
  ViewOptions options = sized(10, 10);
  options.rotation_degrees = Vec3{angle(), angle(), angle()};
  const Camera c = make_camera(options, {}, {});
  RC_ASSERT(std::fabs(dot(c.right, c.up)) < 1e-12);
  RC_ASSERT(length(cross(c.right, c.up) + c.forward) < 1e-12);
  RC_ASSERT(std::fabs(length(c.right) - 1) < 1e-12 && std::fabs(length(c.up) - 1) < 1e-12);
}

RC_GTEST_PROP(View, VectorFormEqualsItsGimbalForm, ()) {
  const int rx = *rc::gen::inRange(1, 180), rz = *rc::gen::inRange(-180, 180);
  ViewOptions gimbal = sized(10, 10);
  gimbal.target = Vec3{1, -2, 3};
  gimbal.rotation_degrees = Vec3{double(rx), 0, double(rz)};
  gimbal.distance = 17;
  const Camera a = make_camera(gimbal, {}, {});
  ViewOptions vector = sized(10, 10);
  vector.eye = a.eye;
  vector.center = gimbal.target;
  const Camera b = make_camera(vector, {}, {});
  RC_ASSERT(length(a.right - b.right) < 1e-9 && length(a.up - b.up) < 1e-9);
}

}  // namespace
}  // namespace whittle

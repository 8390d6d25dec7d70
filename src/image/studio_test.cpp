#include "image/studio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "image/scene_for_test.h"

namespace whittle {
namespace {

const Workers kStudioThreads(0);
constexpr Box kCube{{-1, -1, 0}, {1, 1, 2}};

/// Of OpenSCAD's default view, with room around the cube.
Camera slanted_camera(int width = 120, int height = 90) {
  ViewOptions options;
  options.target = Vec3{0, 0, 1}, options.distance = 14;
  options.rotation_degrees = Vec3{55, 0, 25};
  options.width = width, options.height = height;
  return make_camera(options, {}, {});
}

ShadeSettings studio() {
  ShadeSettings settings;
  settings.style = Style::kStudio;
  settings.solid = kCube;
  return settings;
}

struct Shot {
  Picture picture;
  size_t cast_rays = 0;
};
Shot shoot(const ShadeSettings& settings, int n = 3, const Workers& workers = kStudioThreads) {
  SceneForTest scene;
  scene.add_box(kCube);
  const Camera camera = slanted_camera();
  const Frame frame = scene.render(camera);
  Picture picture = shade_studio(scene, camera, frame, {}, settings, n, workers);
  return {std::move(picture), scene.cast_rays};
}

/// Sum of the first three bytes.
int brightness(const Picture& picture, int x, int y) {
  const uint8_t* p = picture.at(x, y);
  return p[0] + p[1] + p[2];
}

/// How much darker a picture is than another, over its columns or all of it.
int darker(const Picture& a, const Picture& b) {
  int sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) sum += brightness(b, x, y) - brightness(a, x, y);
  return sum;
}

TEST(Studio, IsTheSameOnAnyNumberOfThreads) {
  for (const Quality quality : {Quality::kDraft, Quality::kGood, Quality::kBest}) {
    ShadeSettings settings = studio();
    settings.quality = quality;
    const Picture expected = shoot(settings, 3, Workers(1)).picture;
    for (const int threads : {2, 5})
      EXPECT_EQ(shoot(settings, 3, Workers(threads)).picture.rgba, expected.rgba);
  }
}

TEST(Studio, ADraftCastsNoRays) {
  ShadeSettings settings = studio();
  settings.quality = Quality::kDraft;
  EXPECT_EQ(shoot(settings).cast_rays, 0u);
  EXPECT_GT(shoot(studio()).cast_rays, 100u);
  settings.quality = Quality::kBest;
  EXPECT_GT(shoot(settings).cast_rays, 16 * 1000u);
}

TEST(Studio, WhatStandsOnTheGroundDarkensIt) {
  ShadeSettings without = studio();
  without.ground = false;
  const Picture bare = shoot(without).picture, shaded = shoot(studio()).picture;
  EXPECT_GT(darker(shaded, bare), 10'000);
  SceneForTest scene;
  scene.add_box(kCube);
  const Frame frame = scene.render(slanted_camera());
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      EXPECT_LE(brightness(shaded, x, y), brightness(bare, x, y));
      // The solid itself has no ground; its edges' pixels show some.
      const auto is_hit = [&](int px, int py) { return frame.at(px, py).hit(); };
      if (x > 0 && y > 0 && x + 1 < frame.width && y + 1 < frame.height && is_hit(x - 1, y) &&
          is_hit(x + 1, y) && is_hit(x, y - 1) && is_hit(x, y + 1) && is_hit(x - 1, y - 1) &&
          is_hit(x + 1, y + 1) && is_hit(x - 1, y + 1) && is_hit(x + 1, y - 1)) {
        EXPECT_EQ(brightness(shaded, x, y), brightness(bare, x, y)) << x << ", " << y;
      }
    }
}

TEST(Studio, WithoutBackgroundTheGroundsShadowIsTranslucentBlack) {
  ShadeSettings settings = studio();
  settings.background = false;
  const Picture picture = shoot(settings).picture;
  EXPECT_EQ(picture.at(0, 0)[3], 0) << "far from the solid there is nothing";
  int most = 0;
  SceneForTest scene;
  scene.add_box(kCube);
  const Frame frame = scene.render(slanted_camera());
  for (int y = 1; y + 1 < picture.height; ++y) {
    for (int x = 1; x + 1 < picture.width; ++x) {
      bool is_apart = true;
      for (int k = 0; k < 9; ++k) is_apart &= !frame.at(x + k % 3 - 1, y + k / 3 - 1).hit();
      const uint8_t* p = picture.at(x, y);
      if (!is_apart) continue;
      most = std::max<int>(most, p[3]);
      EXPECT_EQ(p[0] + p[1] + p[2], 0);
    }
  }
  EXPECT_GT(most, 40);
  EXPECT_LT(most, 230);
  settings.ground = false;
  const Picture bare = shoot(settings).picture;
  EXPECT_EQ(bare.at(60, 85)[3], 0);
}

TEST(Studio, TheGroundsShadowIsEvenAlongAnEvenSide) {
  // Of a long wall, seen from above: near its middle nothing changes along it.
  SceneForTest scene;
  scene.add_box({{-9, -1, 0}, {9, 1, 2}});
  const Camera camera = camera_from_above(400, 8);
  const Frame frame = scene.render(camera);
  ShadeSettings settings = studio();
  settings.solid = {{-9, -1, 0}, {9, 1, 2}};
  settings.background = false;
  const Picture picture = shade_studio(scene, camera, frame, {}, settings, 1, kStudioThreads);
  for (const int y : {50, 100, 140, 148}) {
    int least = 255, most = 0;
    for (int x = 150; x < 250; ++x) {
      ASSERT_FALSE(frame.at(x, y).hit());
      least = std::min<int>(least, picture.at(x, y)[3]);
      most = std::max<int>(most, picture.at(x, y)[3]);
    }
    EXPECT_LE(most - least, 3) << y;
  }
  EXPECT_GT(picture.at(200, 148)[3], 20);
}

TEST(Studio, AnEyeBelowTheGroundSeesNone) {
  SceneForTest scene;
  scene.add_box(kCube);
  ViewOptions options;
  options.target = Vec3{0, 0, 1}, options.distance = 14;
  options.rotation_degrees = Vec3{125, 0, 25};
  options.width = options.height = 60;
  const Camera camera = make_camera(options, {}, {});
  const Frame frame = scene.render(camera);
  ShadeSettings settings = studio();
  const Picture with = shade_studio(scene, camera, frame, {}, settings, 1, kStudioThreads);
  settings.ground = false;
  EXPECT_EQ(shade_studio(scene, camera, frame, {}, settings, 1, kStudioThreads).rgba, with.rgba);
}

TEST(Studio, ALinePartsWhatLooksAlike) {
  // Two levels of one colour and one normal, seen from above: the step is at x = 0.03.
  SceneForTest scene;
  scene.add_plane({0, 0, 1}, 0);
  scene.add_box({{0.03, -9, 0}, {9, 9, 3}});
  const Camera camera = camera_from_above(40, 4);
  const Frame frame = scene.render(camera);
  ShadeSettings settings = studio();
  settings.quality = Quality::kDraft;
  const Picture picture = shade_studio(scene, camera, frame, {}, settings, 3, kStudioThreads);
  const int level = brightness(picture, 5, 20);
  EXPECT_EQ(brightness(picture, 35, 20), level) << "both look alike";
  EXPECT_LT(std::min(brightness(picture, 19, 20), brightness(picture, 20, 20)), level * 5 / 6);
  EXPECT_EQ(brightness(picture, 17, 20), level) << "the line is fine";
  EXPECT_EQ(brightness(picture, 22, 20), level);
}

TEST(Studio, ALineKeepsItsWeightWhereverItFallsBetweenPixels) {
  std::vector<int> weights;
  for (int shift = 0; shift < 10; ++shift) {
    SceneForTest scene;
    scene.add_plane({0, 0, 1}, 0);
    scene.add_box({{0.01 * shift + 0.001, -9, 0}, {9, 9, 3}});
    const Camera camera = camera_from_above(40, 4);
    ShadeSettings settings = studio();
    settings.quality = Quality::kDraft;
    const Picture picture =
        shade_studio(scene, camera, scene.render(camera), {}, settings, 4, kStudioThreads);
    int weight = 0;
    for (int x = 10; x < 30; ++x) weight += brightness(picture, 5, 20) - brightness(picture, x, 20);
    weights.push_back(weight);
  }
  const auto [least, most] = std::ranges::minmax(weights);
  EXPECT_GT(least, 100);
  EXPECT_LT(most, least * 3 / 2);
}

TEST(Studio, ADeepHoleIsDark) {
  // Looking down on a floor between four walls, as deep as four times its width.
  const auto floor_brightness = [](double depth) {
    SceneForTest scene;
    scene.add_plane({0, 0, 1}, 0);
    if (depth > 0) {
      scene.add_box({{-9, -9, 0}, {-0.5, 9, depth}});
      scene.add_box({{0.5, -9, 0}, {9, 9, depth}});
      scene.add_box({{-0.5, -9, 0}, {0.5, -0.5, depth}});
      scene.add_box({{-0.5, 0.5, 0}, {0.5, 9, depth}});
    }
    const Camera camera = camera_from_above(80, 4);
    ShadeSettings settings = studio();
    settings.solid = {{-9, -9, 0}, {9, 9, 4}};
    return brightness(
        shade_studio(scene, camera, scene.render(camera), {}, settings, 3, kStudioThreads), 40, 40);
  };
  EXPECT_LT(floor_brightness(4), floor_brightness(0) * 3 / 4);
  EXPECT_LT(floor_brightness(1), floor_brightness(0) - 30);
}

TEST(Studio, StoppedItReturnsSoon) {
  SceneForTest scene;
  scene.add_box(kCube);
  const Camera camera = slanted_camera();
  const Frame frame = scene.render(camera);
  std::stop_source source;
  source.request_stop();
  shade_studio(scene, camera, frame, {}, studio(), 3, kStudioThreads, source.get_token());
  EXPECT_EQ(scene.cast_rays, 0u);
}

}  // namespace
}  // namespace whittle

#include "image/veil.h"

#include <gtest/gtest.h>

#include "image/scene_for_test.h"

namespace whittle {
namespace {

constexpr int kVeilSide = 4;

/// Every ray crosses the same level planes, at distances from the eye 50 above.
class LevelsForTest : public SceneForTest {
 public:
  LevelsForTest(std::vector<std::pair<double, uint32_t>> levels) : levels_(std::move(levels)) {}
  Frame render(const Camera& camera, const RenderControl& = {}) override {
    Frame frame(camera.width, camera.height);
    for (Hit& hit : frame.hits) hit = {float(levels_[0].first), levels_[0].second, Vec3f{0, 0, 1}};
    return frame;
  }
  void cast_through(std::span<const Ray> rays, RayCrossings& found) override {
    found = {};
    for (size_t i = 0; i < rays.size(); ++i) {
      bool enters = false;
      for (const auto& [distance, id] : levels_) {
        enters = !enters;
        found.all.push_back({distance, id, enters, {0, 0, enters ? 1.0 : -1.0}});
      }
      found.ends.push_back(found.all.size());
    }
  }

 private:
  std::vector<std::pair<double, uint32_t>> levels_;
};

constexpr Rgba kHalfRed{1, 0, 0, 0.5f}, kFullGreen{0, 1, 0, 1}, kThinBlue{0, 0, 1, 0.25f};

struct Seen {
  std::vector<VeilWall> walls;  ///< of the first ray
  Vec3f color;
};

/// What is seen of layers in front of an opaque level, white, at a distance; 0: nothing is there.
Seen look_through(std::vector<LevelsForTest*> tracers, double opaque, uint32_t ghost = 99) {
  const Camera camera = camera_from_above(kVeilSide, 10);
  ShadeSettings settings;
  settings.style = Style::kOpenscad;
  settings.is_preview = true;
  std::vector<VeilLayer> layers;
  for (size_t i = 0; i < tracers.size(); ++i)
    layers.push_back({tracers[i], tracers[i]->render(camera), 0, i == ghost});
  const std::vector<Appearance> looks{
      {}, {kHalfRed, false}, {kFullGreen, false}, {kThinBlue, false}};
  Veil veil(std::move(layers), looks, camera, settings, 1e-4);
  const std::vector<PixelPosition> places{{1.5f, 1.5f}};
  std::vector<Hit> hits(1);
  if (opaque > 0) hits[0] = {float(opaque), 2, {0, 0, 1}};
  VeilSight sight;
  veil.look(places, hits, sight);
  VeilScratch scratch;
  veil.find_walls(sight, 0, 1, scratch);
  Colors colors;
  colors.resize(1);
  colors.r[0] = colors.g[0] = colors.b[0] = colors.alpha[0] = 1;
  veil.cover(places, scratch, colors, 0);
  return {scratch.walls, {colors.r[0], colors.g[0], colors.b[0]}};
}

/// What OpenSCAD's lights leave of a level surface seen from above: 0.2 + 1/sqrt(3).
const float kLevel = 0.2f + 1 / std::sqrt(3.0f);

TEST(Veil, EachWallHidesItsShare) {
  LevelsForTest slab({{40, 1}, {45, 1}});
  const Seen seen = look_through({&slab}, 50);
  ASSERT_EQ(seen.walls.size(), 2u);
  EXPECT_NEAR(seen.color.x, 0.75f * kLevel + 0.25f, 1e-5f);
  EXPECT_NEAR(seen.color.y, 0.25f, 1e-5f);
}

TEST(Veil, WallsAreSeenInTheOrderOfTheRayWhateverThatOfTheLayers) {
  LevelsForTest near({{40, 1}, {41, 1}}), far({{44, 3}, {46, 3}});
  const Seen a = look_through({&near, &far}, 50), b = look_through({&far, &near}, 50);
  ASSERT_EQ(a.walls.size(), 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(a.walls[i].distance, b.walls[i].distance);
  EXPECT_EQ(a.color, b.color);
  EXPECT_NEAR(a.color.z, 0.25f * (1 - 0.75f * 0.75f) * kLevel + 0.25f * 0.75f * 0.75f, 1e-5f);
}

TEST(Veil, NothingIsSeenBehindWhatIsOpaque) {
  LevelsForTest slab({{40, 1}, {45, 1}}), mixed({{40, 1}, {42, 2}, {44, 1}, {46, 1}});
  EXPECT_EQ(look_through({&slab}, 42).walls.size(), 1u);
  EXPECT_EQ(look_through({&slab}, 39).walls.size(), 0u);
  const Seen seen = look_through({&mixed}, 50);
  EXPECT_EQ(seen.walls.size(), 2u) << "an opaque wall of a layer ends it, too";
  EXPECT_NEAR(seen.color.y, 0.5f * kLevel, 1e-5f);
}

TEST(Veil, WhatIsOpaqueHidesTheWallThatLiesOnIt) {
  LevelsForTest slab({{40, 1}, {45, 1}});
  EXPECT_EQ(look_through({&slab}, 45).walls.size(), 1u);
  EXPECT_EQ(look_through({&slab}, 45 - 1e-5).walls.size(), 1u);
  EXPECT_EQ(look_through({&slab}, 45 + 1e-5).walls.size(), 1u);
  EXPECT_EQ(look_through({&slab}, 45 + 1e-2).walls.size(), 2u) << "farther than the tolerance";
}

TEST(Veil, AGhostLiesOnWhatIsThere) {
  LevelsForTest ghost({{40, 1}, {45, 1}}), on_top({{45, 1}, {46, 1}});
  EXPECT_EQ(look_through({&ghost}, 45, 0).walls.size(), 2u);
  EXPECT_EQ(look_through({&on_top}, 45, 0).walls.size(), 1u);
  // Of two solids that are entered at once the statement that comes first is in front.
  EXPECT_EQ(look_through({&on_top}, 45).walls.size(), 1u) << "1 comes before 2";
  LevelsForTest later({{45, 3}, {46, 3}});
  EXPECT_EQ(look_through({&later}, 45).walls.size(), 0u) << "3 comes after 2";
}

}  // namespace
}  // namespace whittle

#include "trace/cpu/crossings.h"

#include <gtest/gtest.h>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// A cube from -1 to 1, and a ray along x.
struct CubeOnRay {
  Scene scene;
  CellTree cells;
  uint32_t wall = 0;  ///< the half-space x <= 1
  LocalRay ray{{-5, 0, 0}, {1, 0, 0}};

  CubeOnRay() {
    Result<Scene> lowered = lower(model_of("cube(2, center = true);"));
    WHITTLE_CHECK(lowered);
    scene = *std::move(lowered);
    cells = subdivide(scene, {});
    for (uint32_t i = 0; i < scene.half_spaces.size(); ++i)
      if (scene.half_spaces[i].f.b.x > 0.1) wall = i;
  }
  RayCrossings crossings(const std::vector<LaneChange>& changes) const {
    RayCrossings found;
    add_crossings(LaneScene(scene, cells), ray, 100, changes, found);
    return found;
  }
  LaneChange change(double t, bool enters) const { return {0, {t, 1, wall, enters, enters}}; }
};

TEST(AddCrossings, TellWhereAndWhichWay) {
  const CubeOnRay cube;
  const RayCrossings found = cube.crossings({cube.change(4, true), cube.change(6, false)});
  ASSERT_EQ(found.ends, (std::vector<size_t>{2}));
  EXPECT_EQ(found.all[0].distance, 104);
  EXPECT_TRUE(found.all[0].enters);
  EXPECT_EQ(found.all[0].normal, (Vec3{-1, 0, 0}));
  EXPECT_EQ(found.all[1].distance, 106);
  EXPECT_FALSE(found.all[1].enters);
  EXPECT_EQ(found.all[1].normal, (Vec3{1, 0, 0}));
}

// Two cells may have found the halves of one crossing.
TEST(AddCrossings, WhatRoundingPartsIsNone) {
  const CubeOnRay cube;
  const double film = 0.5 * LaneScene(cube.scene, cube.cells).ray_tolerance;
  EXPECT_EQ(cube.crossings({cube.change(4, true), cube.change(4 + film, false)}).all.size(), 0u);
  EXPECT_EQ(cube.crossings({cube.change(4, true), cube.change(4 + 9 * film, false)}).all.size(),
            2u);
  const RayCrossings found = cube.crossings({cube.change(4, true), cube.change(5, false),
                                             cube.change(5 + film, true), cube.change(6, false)});
  ASSERT_EQ(found.all.size(), 2u);
  EXPECT_EQ(found.all[1].distance, 106);
}

TEST(AddCrossings, WhereCellsDisagreeTheSpanIsClosed) {
  const CubeOnRay cube;
  const LaneChange unknown{0, {5, 0, LaneChange::kNoHalfSpace, false, false}};
  const RayCrossings found = cube.crossings({cube.change(4, true), unknown});
  ASSERT_EQ(found.all.size(), 2u);
  EXPECT_EQ(found.all[1].id, 1u);
  EXPECT_EQ(found.all[1].normal, (Vec3{1, 0, 0}));
  EXPECT_FALSE(found.all[1].enters);
}

}  // namespace
}  // namespace whittle

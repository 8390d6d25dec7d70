#include "model/section.h"

#include <gtest/gtest.h>

#include <limits>

namespace whittle {
namespace {

/// Two cubes in a row.
Model two_cubes() {
  Model model;
  model.file = "two.csg";
  model.nodes.push_back({.kind = NodeKind::kUnion, .end = 3, .where = {}});
  for (uint32_t i = 0; i < 2; ++i) {
    model.nodes.push_back(
        {.kind = NodeKind::kPrimitive, .end = i + 2, .payload = i, .where = {i + 1, 1}});
    model.primitives.push_back({Cube{.size = {1, 2, 3}, .center = false}, i + 1});
  }
  model.statement_count = 2;
  return model;
}

TEST(CutOpen, PlanesAreNumberedBehindAllStatements) {
  const Model cut = *cut_open(
      two_cubes(), std::vector<Section>{{{{{1, 0, 0}, 5}, {{0, 1, 0}, 6}}}, {{{{0, 0, 1}, 7}}}});
  ASSERT_TRUE(cut.cut);
  EXPECT_EQ(cut.statement_count, 5u);
  EXPECT_EQ(written_statements(cut), 2u);
  EXPECT_EQ(cut.cut->first_plane, 3u);
  EXPECT_EQ(cut.cut->last_plane, 5u);
  EXPECT_EQ(cut.cut->statement_of(cut.cut->cap_of(2)), 2u);
  EXPECT_TRUE(cut.cut->is_cap(cut.cut->cap_of(1)));
  EXPECT_FALSE(cut.cut->is_cap(2));
  ASSERT_EQ(cut.primitives.size(), 5u);
  for (uint32_t id = 1; id <= 5; ++id) EXPECT_EQ(cut.primitives[id - 1].id, id);
  EXPECT_EQ(cut.nodes[0].end, cut.nodes.size());
}

TEST(CutOpen, CanBeTakenBack) {
  const Model whole = two_cubes();
  const std::vector<Section> section{{{{{1, 0, 0}, 0}}}};
  // Again and again.
  const Model back = uncut(*cut_open(*cut_open(whole, section), section));
  EXPECT_FALSE(back.cut);
  EXPECT_EQ(back.statement_count, 2u);
  EXPECT_EQ(back.primitives.size(), 2u);
  for (const Node& node : back.nodes)
    EXPECT_TRUE(node.kind != NodeKind::kPrimitive || node.payload < 2);
}

TEST(CutOpen, WhatIsFlatIsRefused) {
  Model model = two_cubes();
  model.drawing.emplace();
  const Result<Model> cut = cut_open(model, std::vector<Section>{{{{{1, 0, 0}, 0}}}});
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().kind, ErrorKind::kUsage);
  EXPECT_NE(cut.error().message.find("flat"), std::string::npos);
}

TEST(CuttingPlane, HasAUnitNormalHoweverLongItWasGiven) {
  for (const double scale : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    const Result<Plane> plane = cutting_plane(Vec3{3, 0, -4} * scale, 10 * scale);
    ASSERT_TRUE(plane) << scale;
    EXPECT_LT(length(plane->n - Vec3{0.6, 0, -0.8}), 1e-15);
    EXPECT_NEAR(plane->d, 2, 1e-14);
  }
}

TEST(CuttingPlane, WhatIsNoneIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(cutting_plane({0, 0, 0}, 1));
  EXPECT_FALSE(cutting_plane({nan, 0, 0}, 1));
  EXPECT_FALSE(cutting_plane({infinite, 0, 0}, 1));
  EXPECT_FALSE(cutting_plane({1, 0, 0}, nan));
  EXPECT_FALSE(cutting_plane({1, 0, 0}, 1e101));
  EXPECT_FALSE(cutting_plane({1e-200, 0, 0}, 1e200));
  EXPECT_TRUE(cutting_plane({1, 0, 0}, 1e100));
}

}  // namespace
}  // namespace whittle

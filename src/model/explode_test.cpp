#include "model/explode.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

/// An operator over cubes in a row along x, the first from 0 to 1, the next from 2 to 3.
Model row_of_cubes(NodeKind kind, uint32_t count) {
  Model model;
  model.file = "row.csg";
  const uint32_t end = 2 + 2 * count;
  model.nodes.push_back({.kind = NodeKind::kUnion, .end = end, .where = {}});
  model.nodes.push_back({.kind = kind, .end = end, .where = {}});
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t at = uint32_t(model.nodes.size());
    model.nodes.push_back({.kind = NodeKind::kTransform, .end = at + 2, .payload = i, .where = {}});
    model.nodes.push_back({.kind = NodeKind::kPrimitive, .end = at + 2, .payload = i, .where = {}});
    model.transforms.push_back(translation({2.0 * i, 0, 0}));
    model.primitives.push_back({Cube{.size = {1, 1, 1}, .center = false}, i + 1});
  }
  model.statement_count = count;
  return model;
}

TEST(Explode, MovesEachPartByItsWayFromTheMiddle) {
  const Result<Model> moved = explode(row_of_cubes(NodeKind::kUnion, 3), 2);
  ASSERT_TRUE(moved);
  ASSERT_EQ(moved->nodes.size(), 11u);
  EXPECT_EQ(moved->nodes[0].end, 11u);
  EXPECT_EQ(moved->nodes[1].end, 11u);
  for (uint32_t i = 0; i < 3; ++i) {
    const Node& mover = moved->nodes[2 + 3 * i];
    EXPECT_EQ(mover.kind, NodeKind::kTransform);
    EXPECT_EQ(mover.end, 5 + 3 * i);
    EXPECT_EQ(moved->nodes[3 + 3 * i].end, mover.end);
    EXPECT_EQ(moved->transforms[mover.payload].translation, (Vec3{4.0 * i - 4, 0, 0}));
  }
}

TEST(Explode, WhatIsOnePartIsRefused) {
  for (const Model& model :
       {row_of_cubes(NodeKind::kUnion, 1), row_of_cubes(NodeKind::kDifference, 2)}) {
    const Result<Model> moved = explode(model, 1);
    ASSERT_FALSE(moved);
    EXPECT_NE(moved.error().message.find("one part"), std::string::npos);
  }
  // Cubes that do not meet have nothing in common.
  EXPECT_NE(explode(row_of_cubes(NodeKind::kIntersection, 2), 1).error().message.find("empty"),
            std::string::npos);
  EXPECT_NE(explode(row_of_cubes(NodeKind::kUnion, 0), 1).error().message.find("empty"),
            std::string::npos);
}

TEST(Explode, APartWithoutEndIsRefused) {
  Model model = row_of_cubes(NodeKind::kUnion, 2);
  model.primitives[1].shape = Halfspace{{1, 1, 0}, 3};
  EXPECT_NE(explode(model, 1).error().message.find("without end"), std::string::npos);
}

}  // namespace
}  // namespace whittle

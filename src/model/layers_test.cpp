#include "model/layers.h"

#include <gtest/gtest.h>

#include "model/part_looks.h"

namespace whittle {
namespace {

constexpr Rgba kGlass{1, 0, 0, 0.5f}, kWater{0, 0, 1, 0.25f}, kRed{1, 0, 0, 1};

/// A tree in a few calls; ids count from 1.
class TreeForLayers {
 public:
  TreeForLayers() { model_.nodes.push_back({}); }
  TreeForLayers& open(NodeKind kind, bool highlight = false) {
    open_.push_back(uint32_t(model_.nodes.size()));
    model_.nodes.push_back({.kind = kind, .highlight = highlight, .where = {}});
    return *this;
  }
  TreeForLayers& color(Rgba color) {
    open(NodeKind::kColor);
    model_.nodes.back().payload = uint32_t(model_.colors.size());
    model_.colors.push_back(color);
    return *this;
  }
  TreeForLayers& move(double x) {
    open(NodeKind::kTransform);
    model_.nodes.back().payload = uint32_t(model_.transforms.size());
    model_.transforms.push_back(translation({x, 0, 0}));
    return *this;
  }
  TreeForLayers& close() {
    model_.nodes[open_.back()].end = uint32_t(model_.nodes.size());
    open_.pop_back();
    return *this;
  }
  TreeForLayers& cube(bool highlight = false) {
    open(NodeKind::kPrimitive, highlight);
    model_.nodes.back().payload = uint32_t(model_.primitives.size());
    model_.primitives.push_back({Cube{.size = {1, 1, 1}}, ++model_.statement_count});
    return close();
  }
  Model done() {
    model_.nodes[0].end = uint32_t(model_.nodes.size());
    return model_;
  }

 private:
  Model model_;
  std::vector<uint32_t> open_;
};

/// As `U(D(1 T(2)) 3)`.
std::string shape_of(const Model& model) {
  std::string text;
  std::vector<uint32_t> ends;
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    while (!ends.empty() && ends.back() <= i) text += ')', ends.pop_back();
    const Node& node = model.nodes[i];
    if (!text.empty() && text.back() != '(') text += ' ';
    if (node.kind == NodeKind::kPrimitive) {
      text += std::to_string(model.primitives[node.payload].id);
      continue;
    }
    text += std::string(1, "UDITP?B"[size_t(node.kind)]) + "(";
    ends.push_back(node.end);
  }
  for (; !ends.empty(); ends.pop_back()) text += ')';
  return text;
}

Layers layers_for_test(const Model& model, const LayerSettings& settings = {}) {
  return layers_of(model, appearances(model), settings);
}

std::string shapes_of(const Layers& layers) {
  std::string text = layers.is_whole ? "whole" : shape_of(layers.opaque);
  for (const Layer& layer : layers.see_through) text += "; " + shape_of(layer.model);
  return text;
}

TEST(Layers, WhatIsOpaqueIsWhole) {
  const Model model = TreeForLayers().color(kRed).cube().close().cube().done();
  const Layers layers = layers_for_test(model);
  EXPECT_TRUE(layers.is_plain());
  EXPECT_TRUE(layers.opaque.nodes.empty()) << "nothing was copied";
}

TEST(Layers, EachSeeThroughColorIsOne) {
  const Model model = TreeForLayers()
                          .color(kGlass)
                          .cube()
                          .close()
                          .cube()
                          .move(1)
                          .color(kWater)
                          .cube()
                          .close()
                          .close()
                          .open(NodeKind::kUnion)
                          .color(kGlass)
                          .cube()
                          .close()
                          .cube()
                          .close()
                          .done();
  EXPECT_EQ(shapes_of(layers_for_test(model)), "U(2 U(5)); U(P(1) U(P(4))); U(T(P(3)) U())");
}

TEST(Layers, ADifferenceIsDividedWithWhatItCuts) {
  const Model model = TreeForLayers()
                          .open(NodeKind::kDifference)
                          .open(NodeKind::kUnion)
                          .color(kGlass)
                          .cube()
                          .close()
                          .cube()
                          .close()
                          .cube()
                          .close()
                          .done();
  EXPECT_EQ(shapes_of(layers_for_test(model)), "U(D(U(2) 3)); U(D(U(P(1)) 3))");
}

TEST(Layers, AnIntersectionIsDividedWithItsOneSeeThroughOperand) {
  const auto with_box = [](bool box_first) {
    TreeForLayers tree;
    tree.open(NodeKind::kIntersection);
    if (box_first) tree.cube();
    tree.open(NodeKind::kUnion).color(kGlass).cube().close().cube().close();
    if (!box_first) tree.cube();
    return shapes_of(layers_for_test(tree.close().done()));
  };
  EXPECT_EQ(with_box(false), "U(I(U(2) 3)); U(I(U(P(1)) 3))");
  EXPECT_EQ(with_box(true), "U(I(1 U(3))); U(I(1 U(P(2))))");
}

TEST(Layers, WhatCannotBeDividedIsSeeThroughAsAWhole) {
  const Model two = TreeForLayers()
                        .open(NodeKind::kIntersection)
                        .open(NodeKind::kUnion)
                        .color(kGlass)
                        .cube()
                        .close()
                        .cube()
                        .close()
                        .open(NodeKind::kUnion)
                        .color(kGlass)
                        .cube()
                        .close()
                        .cube()
                        .close()
                        .close()
                        .done();
  EXPECT_EQ(shapes_of(layers_for_test(two)), "U(); U(I(U(P(1) 2) U(P(3) 4)))");
  const Model cutter = TreeForLayers()
                           .open(NodeKind::kDifference)
                           .cube()
                           .color(kGlass)
                           .cube()
                           .close()
                           .close()
                           .cube()
                           .done();
  EXPECT_EQ(shapes_of(layers_for_test(cutter)), "U(3); U(D(1 P(2)))") << "its cut is see-through";
}

TEST(Layers, ManyColorsAreOneSolid) {
  TreeForLayers tree;
  for (size_t i = 0; i < kMostSeeThroughColors + 3; ++i)
    tree.color({float(i) / 100, 0, 0, 0.5f}).cube().close();
  const Layers layers = layers_for_test(tree.done());
  EXPECT_TRUE(layers.has_many_colors);
  ASSERT_EQ(layers.see_through.size(), kMostSeeThroughColors + 1);
}

TEST(Layers, HighlightsLeaveTheOutermostUnionsAlone) {
  const Model model = TreeForLayers()
                          .move(2)
                          .cube(true)
                          .cube()
                          .close()
                          .open(NodeKind::kDifference)
                          .cube()
                          .cube(true)
                          .close()
                          .done();
  EXPECT_TRUE(layers_for_test(model).is_plain()) << "nobody asked for ghosts";
  const Layers layers = layers_for_test(model, {.ghosts = true});
  EXPECT_EQ(shapes_of(layers), "U(T(2) D(3 4)); U(T(1) 4)");
  EXPECT_EQ(layers.see_through[0].kind, LayerKind::kHighlight);
  EXPECT_EQ(instances(layers.see_through[0].model)[0].world_from_object.translation,
            (Vec3{2, 0, 0}));
}

TEST(Layers, AMarkedMinuendMarksTheDifference) {
  const Model model =
      TreeForLayers().open(NodeKind::kDifference).cube(true).cube().close().cube().done();
  EXPECT_EQ(shapes_of(layers_for_test(model, {.ghosts = true})), "U(3); U(D(1 2))");
}

TEST(Layers, ThrownTogetherShowsCutters) {
  const Model model = TreeForLayers()
                          .open(NodeKind::kDifference)
                          .cube()
                          .cube()
                          .close()
                          .open(NodeKind::kIntersection)
                          .cube()
                          .cube()
                          .close()
                          .done();
  EXPECT_EQ(shapes_of(layers_for_test(model, {.thrown_together = true})), "U(U(1 2) U(3 4))");
}

std::vector<Appearance> part_looks_of(const Model& model, bool& known) {
  std::vector<Appearance> looks = appearances(model);
  known = set_part_looks(model, looks);
  return looks;
}

TEST(PartLooks, ACutHasTheLookOfWhatWasCut) {
  bool known = false;
  const Model model = TreeForLayers()
                          .open(NodeKind::kDifference)
                          .color(kRed)
                          .cube()
                          .close()
                          .color(kWater)
                          .cube()
                          .close()
                          .open(NodeKind::kDifference)
                          .cube()
                          .cube()
                          .close()
                          .close()
                          .open(NodeKind::kDifference)
                          .cube()
                          .cube()
                          .close()
                          .done();
  const std::vector<Appearance> looks = part_looks_of(model, known);
  EXPECT_TRUE(known);
  for (const uint32_t id : {1, 2, 3, 4}) EXPECT_EQ(looks[id].color, kRed) << id;
  EXPECT_FALSE(looks[6].color.is_valid());
  EXPECT_FALSE(looks[6].cut) << "it is painted as material";
}

TEST(PartLooks, WhatCutsPartsOfSeveralColorsKeepsItsOwn) {
  bool known = true;
  const Model model = TreeForLayers()
                          .open(NodeKind::kDifference)
                          .open(NodeKind::kUnion)
                          .color(kRed)
                          .cube()
                          .close()
                          .cube()
                          .close()
                          .color(kWater)
                          .cube()
                          .close()
                          .close()
                          .done();
  const std::vector<Appearance> looks = part_looks_of(model, known);
  EXPECT_FALSE(known);
  EXPECT_EQ(looks[3].color, kWater);
  EXPECT_TRUE(looks[3].cut);
}

}  // namespace
}  // namespace whittle

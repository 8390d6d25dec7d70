#include "image/pov.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "trace/view.h"

namespace whittle {
namespace {

/// Writes a model by hand, statement by statement.
class Builder {
 public:
  Builder() { open(NodeKind::kUnion); }
  Builder& open(NodeKind kind, uint32_t payload = 0, bool background = false) {
    open_.push_back(uint32_t(model_.nodes.size()));
    model_.nodes.push_back(
        {.kind = kind, .background = background, .payload = payload, .where = {}});
    return *this;
  }
  Builder& close() {
    model_.nodes[open_.back()].end = uint32_t(model_.nodes.size());
    open_.pop_back();
    return *this;
  }
  Builder& transform(const Affine& a) {
    model_.transforms.push_back(a);
    return open(NodeKind::kTransform, uint32_t(model_.transforms.size() - 1));
  }
  Builder& color(Rgba c) {
    model_.colors.push_back(c);
    return open(NodeKind::kColor, uint32_t(model_.colors.size() - 1));
  }
  Builder& add(Shape shape, bool background = false) {
    model_.primitives.push_back({std::move(shape), ++model_.statement_count});
    open(NodeKind::kPrimitive, uint32_t(model_.primitives.size() - 1), background);
    return close();
  }
  Model done() {
    while (!open_.empty()) close();
    return model_;
  }

 private:
  Model model_;
  std::vector<uint32_t> open_;
};

/// The scene after the light: the solid, blanks squeezed.
std::string solid_of(const Model& model) {
  const Result<std::string> text = write_pov(model, make_camera({}, {}, {}), {});
  EXPECT_TRUE(text);
  const size_t light = text->find("light_source");
  std::string squeezed;
  for (const char c : text->substr(text->find('\n', light) + 1)) {
    if (c == ' ' || c == '\n') {
      if (!squeezed.empty() && squeezed.back() != ' ') squeezed += ' ';
    } else {
      squeezed += c;
    }
  }
  EXPECT_EQ(std::count(squeezed.begin(), squeezed.end(), '{'),
            std::count(squeezed.begin(), squeezed.end(), '}'));
  return squeezed;
}

size_t times(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

const Cube kEmptyCube{{0, 1, 1}, false};

TEST(Pov, AnOperatorOfOneOperandIsThatOperand) {
  const std::string text = solid_of(Builder()
                                        .open(NodeKind::kUnion)
                                        .open(NodeKind::kIntersection)
                                        .open(NodeKind::kDifference)
                                        .add(Sphere{2})
                                        .add(kEmptyCube)
                                        .done());
  EXPECT_EQ(text.find("sphere { <0, 0, 0>, 2"), 0u) << text;
  EXPECT_EQ(times(text, "{"), 2u) << text;
  EXPECT_EQ(times(text, "no_shadow"), 1u);
}

TEST(Pov, WhatIsSurelyEmptyIsNotWritten) {
  EXPECT_EQ(solid_of(Builder().done()), "");
  const Cube cube;
  EXPECT_EQ(solid_of(Builder().open(NodeKind::kDifference).add(kEmptyCube).add(cube).done()), "");
  EXPECT_EQ(solid_of(Builder().open(NodeKind::kIntersection).add(cube).add(kEmptyCube).done()), "");
  EXPECT_EQ(solid_of(Builder().open(NodeKind::kIntersection).done()), "");
  EXPECT_EQ(solid_of(Builder().transform(scaling({1, 1, 0})).add(cube).done()), "");
}

TEST(Pov, AnIntersectionOfNothingIsNoOperand) {
  const std::string text = solid_of(
      Builder().open(NodeKind::kDifference).add(Sphere{2}).open(NodeKind::kIntersection).done());
  EXPECT_EQ(text.find("sphere"), 0u) << text;
}

TEST(Pov, BackgroundIsNoOperand) {
  const std::string text = solid_of(
      Builder().open(NodeKind::kDifference).add(Sphere{9}, true).add(Cube{}).add(Sphere{3}).done());
  EXPECT_EQ(text.find("difference { box"), 0u) << text;
  EXPECT_EQ(times(text, "sphere"), 1u);
}

TEST(Pov, OperandsStayFlatAndInOrder) {
  Builder builder;
  builder.open(NodeKind::kDifference);
  for (int i = 1; i <= 5; ++i) builder.add(Sphere{double(i)});
  const std::string text = solid_of(builder.done());
  EXPECT_EQ(times(text, "difference"), 1u);
  for (int i = 1; i < 5; ++i) {
    EXPECT_LT(text.find("<0, 0, 0>, " + std::to_string(i)),
              text.find("<0, 0, 0>, " + std::to_string(i + 1)));
  }
}

TEST(Pov, EachShapeHasItsObject) {
  const auto one = [](Shape shape) { return solid_of(Builder().add(std::move(shape)).done()); };
  EXPECT_EQ(one(Cube{{1, 2, 3}, true}).find("box { <-0.5, -1, -1.5>, <0.5, 1, 1.5>"), 0u);
  EXPECT_EQ(one(Cube{{1, 2, 3}, false}).find("box { <0, 0, 0>, <1, 2, 3>"), 0u);
  EXPECT_EQ(one(Cylinder{4, 2, 2}).find("cylinder { <0, 0, 0>, <0, 0, 4>, 2"), 0u);
  EXPECT_EQ(one(Cylinder{4, 2, 0, true}).find("cone { <0, 0, -2>, 2, <0, 0, 2>, 0"), 0u);
  EXPECT_EQ(one(Halfspace{{0, 0, 2}, 6}).find("plane { <0, 0, 1>, 3"), 0u);
  const std::string prism = one(Cylinder{4, 2, 2, false, 6});
  EXPECT_EQ(prism.find("intersection {"), 0u);
  EXPECT_EQ(times(prism, "plane {"), 8u);
  EXPECT_EQ(times(prism, "bounded_by"), 1u);
}

TEST(Pov, TheMatrixHoldsTheImagesOfTheAxes) {
  const Affine a{.row = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, .translation = {11, 12, 13}};
  const std::string text = solid_of(Builder().transform(a).add(Cube{}).done());
  EXPECT_NE(text.find("matrix <1, 4, 7, 2, 5, 8, 3, 6, 10, 11, 12, 13>"), std::string::npos)
      << text;
}

TEST(Pov, PrimitivesKeepTheirOwnColors) {
  const std::string text = solid_of(Builder()
                                        .open(NodeKind::kDifference)
                                        .color({1, 0.5f, 0.25f, 1})
                                        .add(Cube{})
                                        .close()
                                        .add(Sphere{1})
                                        .done());
  EXPECT_NE(text.find("pigment { rgb <1, 0.5, 0.25> }"), std::string::npos) << text;
  EXPECT_EQ(times(text, "pigment"), 2u);
}

TEST(Pov, DeepNestingCostsNoStack) {
  Builder builder;
  for (int i = 0; i < 100'000; ++i) {
    builder.open(i % 2 ? NodeKind::kDifference : NodeKind::kUnion).add(Sphere{1});
  }
  const std::string text = solid_of(builder.done());
  EXPECT_EQ(times(text, "sphere"), 100'000u);
}

TEST(Pov, ACameraOrLightThatIsNotFiniteIsAnError) {
  Camera camera = make_camera({}, {}, {});
  ShadeSettings settings;
  settings.light = Vec3{0, std::numeric_limits<double>::infinity(), 0};
  const Model model = Builder().add(Cube{}).done();
  EXPECT_FALSE(write_pov(model, camera, settings));
  camera.eye.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(write_pov(model, camera, {}));
}

}  // namespace
}  // namespace whittle

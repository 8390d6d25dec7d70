#include "model/instances.h"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "base/degrees.h"

namespace whittle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Writes the preorder array: open(), children, close().
class Builder {
 public:
  Builder() { open(NodeKind::kUnion); }

  Builder& open(NodeKind kind, uint32_t payload = 0, bool background = false) {
    open_.push_back(uint32_t(model_.nodes.size()));
    model_.nodes.push_back({.kind = kind,
                            .background = background,
                            .end = 0,
                            .payload = payload,
                            .where = {uint32_t(model_.nodes.size()), 1}});
    return *this;
  }
  Builder& transform(const Affine& map) {
    model_.transforms.push_back(map);
    return open(NodeKind::kTransform, uint32_t(model_.transforms.size() - 1));
  }
  Builder& color(Rgba color) {
    model_.colors.push_back(color);
    return open(NodeKind::kColor, uint32_t(model_.colors.size() - 1));
  }
  Builder& add(Shape shape, bool background = false) {
    model_.primitives.push_back({std::move(shape), ++model_.statement_count});
    open(NodeKind::kPrimitive, uint32_t(model_.primitives.size() - 1), background);
    return close();
  }
  Builder& close() {
    model_.nodes[open_.back()].end = uint32_t(model_.nodes.size());
    open_.pop_back();
    return *this;
  }
  Model done() {
    while (!open_.empty()) close();
    return model_;
  }

 private:
  Model model_;
  std::vector<uint32_t> open_;
};

Shape unit_cube() {
  return Cube{.size = {1, 1, 1}, .center = false};
}
Affine shift(double x, double y, double z) {
  return translation({x, y, z});
}

Affine quarter_turn_about_z() {
  return {.row = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, .translation = {}};
}

TEST(Instances, MultiplyOuterToInner) {
  const Model model = Builder()
                          .transform(shift(10, 0, 0))
                          .transform(quarter_turn_about_z())
                          .transform(shift(1, 0, 0))
                          .add(unit_cube())
                          .close()
                          .close()
                          .close()
                          .add(Sphere{})
                          .done();
  const auto found = instances(model);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].world_from_object.point({0, 0, 0}), (Vec3{10, 1, 0}));
  EXPECT_EQ(found[0].node, 4u);
  EXPECT_EQ(found[1].world_from_object, Affine{});
  EXPECT_EQ(found[1].primitive, 1u);
}

TEST(Instances, BackgroundIsLeftOut) {
  const Model model = Builder()
                          .open(NodeKind::kUnion, 0, true)
                          .add(unit_cube())
                          .close()
                          .add(Sphere{})
                          .add(unit_cube(), true)
                          .done();
  const auto found = instances(model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].primitive, 1u);
}

TEST(Instances, FlattenedAndNonFiniteAreEmpty) {
  const Model model = Builder()
                          .transform(scaling({1, 1, 0}))
                          .add(unit_cube())
                          .close()
                          .transform(shift(kInfinite, 0, 0))
                          .add(unit_cube())
                          .close()
                          .transform(scaling({1e-6, 1, 1}))
                          .add(unit_cube())
                          .close()
                          .add(Cube{.size = {1e200, 1, 1}})
                          .add(Sphere{.r = 0})
                          .done();
  const auto found = instances(model);
  ASSERT_EQ(found.size(), 5u);
  EXPECT_TRUE(found[0].empty);
  EXPECT_TRUE(found[1].empty);
  EXPECT_FALSE(found[2].empty) << "squashed by a million is still a solid";
  EXPECT_TRUE(found[3].empty) << "its diagonal overflows";
  EXPECT_TRUE(found[4].empty);
  const auto warnings = transform_warnings(model);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find(":1:1: warning: this transform flattens"), std::string::npos);
  EXPECT_NE(warnings[1].find(":3:1: warning: this transform is not finite"), std::string::npos);
}

TEST(Instances, WhatIsTooFarToComputeIsEmpty) {
  const Model model = Builder()
                          .add(Halfspace{.n = {1, 0, 0}, .d = 1e151})
                          .add(Halfspace{.n = {1e-160, 0, 0}, .d = 1e-8})
                          .add(Halfspace{.n = {1, 0, 0}, .d = 1e149})
                          .transform(shift(1e151, 0, 0))
                          .add(unit_cube())
                          .close()
                          .transform(shift(0, -1e149, 0))
                          .add(unit_cube())
                          .close()
                          .done();
  const auto found = instances(model);
  ASSERT_EQ(found.size(), 5u);
  EXPECT_TRUE(found[0].empty);
  EXPECT_TRUE(found[1].empty);
  EXPECT_FALSE(found[2].empty);
  EXPECT_TRUE(found[3].empty);
  EXPECT_FALSE(found[4].empty);
  const Bounds b = bounds(model);
  EXPECT_TRUE(std::isfinite(dot(view_region(b).size(), view_region(b).size())));
}

TEST(Instances, RangesTogetherAreTheWholeWalk) {
  Builder builder;
  builder.transform(quarter_turn_about_z());
  for (int i = 0; i < 300; ++i) {
    builder.transform(shift(1, i, 0)).add(unit_cube(), true).open(NodeKind::kUnion, 0, i % 9 == 0);
    builder.transform(scaling({2, 1, 1})).add(unit_cube()).add(Sphere{1, 0}).close();
    builder.add(Sphere{0, 0}).close();
    // Nested ever more deeply in the middle.
    if (i < 100 || i >= 200) builder.close();
  }
  const Model model = builder.done();
  const std::vector<Instance> whole = instances(model);
  const auto same = [](const Instance& a, const Instance& b) {
    return a.node == b.node && a.primitive == b.primitive && a.empty == b.empty &&
           a.world_from_object == b.world_from_object;
  };
  for (const size_t nodes_each : {1, 7, 100, 1'000'000}) {
    std::vector<Instance> found;
    for (const InstanceRange& range : instance_ranges(model, nodes_each)) {
      EXPECT_EQ(range.first, found.size());
      InstanceWalk walk(model, range);
      while (const Instance* instance = walk.next()) found.push_back(*instance);
      EXPECT_EQ(range.first + range.count, found.size());
    }
    EXPECT_TRUE(std::equal(found.begin(), found.end(), whole.begin(), whole.end(), same));
  }
}

TEST(Instances, AMillionDeep) {
  Builder builder;
  for (int i = 0; i < 1000000; ++i) {
    if (i % 2)
      builder.open(NodeKind::kDifference);
    else
      builder.transform(shift(1, 0, 0));
  }
  const Model model = builder.add(unit_cube()).done();
  EXPECT_EQ(instances(model).at(0).world_from_object.translation, (Vec3{500000, 0, 0}));
  EXPECT_EQ(bounds(model).box, (Box{{500000, 0, 0}, {500001, 1, 1}}));
  EXPECT_FALSE(appearances(model).at(1).cut);
}

TEST(Appearances, OutermostValidColourWins) {
  const Rgba red{1, 0, 0, 1}, green{0, 1, 0, 1}, partial{0, 0, 1, -1};
  const Model model = Builder()
                          .color(red)
                          .color(green)
                          .add(unit_cube())
                          .close()
                          .close()
                          .color(partial)
                          .color(green)
                          .add(unit_cube())
                          .close()
                          .close()
                          .add(unit_cube())
                          .done();
  const auto looks = appearances(model);
  ASSERT_EQ(looks.size(), 4u);
  EXPECT_FALSE(looks[0].color.is_valid());
  EXPECT_EQ(looks[1].color, red);
  EXPECT_EQ(looks[2].color, green);
  EXPECT_FALSE(looks[3].color.is_valid());
}

TEST(Appearances, CutIsAnOddNumberOfSubtractions) {
  // difference { %cube; cube; union { cube; difference { cube; cube } } cube }
  const Model model = Builder()
                          .open(NodeKind::kDifference)
                          .add(unit_cube(), true)
                          .add(unit_cube())
                          .open(NodeKind::kUnion)
                          .add(unit_cube())
                          .open(NodeKind::kDifference)
                          .add(unit_cube())
                          .add(unit_cube())
                          .close()
                          .close()
                          .add(unit_cube())
                          .done();
  const auto looks = appearances(model);
  EXPECT_FALSE(looks[2].cut) << "the first child that is not under % is the minuend";
  EXPECT_TRUE(looks[3].cut);
  EXPECT_TRUE(looks[4].cut);
  EXPECT_FALSE(looks[5].cut) << "subtracted from what is subtracted";
  EXPECT_TRUE(looks[6].cut);
}

TEST(LonePrimitive, IsOneThatNothingWasCombinedWith) {
  const Shape nothing = Cube{.size = {0, 1, 1}, .center = false};
  const auto wrapped = [] { return Builder().open(NodeKind::kUnion).color({1, 0, 0, 1}); };
  EXPECT_EQ(lone_primitive(Builder().done()), std::nullopt);
  EXPECT_EQ(lone_primitive(wrapped().add(unit_cube()).done()), 1u);
  EXPECT_EQ(lone_primitive(wrapped().add(unit_cube()).add(unit_cube()).done()), std::nullopt);
  // What is empty is no operand of a union.
  EXPECT_EQ(lone_primitive(wrapped().add(nothing).add(unit_cube()).done()), 2u);
  EXPECT_EQ(lone_primitive(wrapped().add(unit_cube(), true).add(unit_cube()).done()), 2u);
  for (const NodeKind kind : {NodeKind::kDifference, NodeKind::kIntersection}) {
    EXPECT_EQ(lone_primitive(Builder().open(kind).add(unit_cube()).done()), 1u);
    EXPECT_EQ(lone_primitive(Builder().open(kind).add(unit_cube()).add(nothing).done()),
              std::nullopt);
    EXPECT_EQ(lone_primitive(Builder().open(kind).add(unit_cube()).add(unit_cube(), true).done()),
              1u);
    EXPECT_EQ(
        lone_primitive(
            Builder().open(kind).add(unit_cube()).open(NodeKind::kUnion).close().close().done()),
        std::nullopt);
  }
}

TEST(Bounds, FollowTheTree) {
  const auto two = [](NodeKind kind) {
    return bounds(Builder()
                      .open(kind)
                      .add(Cube{.size = {2, 2, 2}})
                      .transform(shift(1, 1, 1))
                      .add(Cube{.size = {2, 2, 2}})
                      .done())
        .box;
  };
  EXPECT_EQ(two(NodeKind::kUnion), (Box{{0, 0, 0}, {3, 3, 3}}));
  EXPECT_EQ(two(NodeKind::kIntersection), (Box{{1, 1, 1}, {2, 2, 2}}));
  EXPECT_EQ(two(NodeKind::kDifference), (Box{{0, 0, 0}, {2, 2, 2}}));
}

TEST(Bounds, EmptyOperandsCount) {
  EXPECT_TRUE(
      bounds(Builder().open(NodeKind::kIntersection).add(unit_cube()).open(NodeKind::kUnion).done())
          .box.is_empty());
  EXPECT_TRUE(
      bounds(Builder().open(NodeKind::kDifference).add(Sphere{.r = 0}).add(unit_cube()).done())
          .box.is_empty());
  EXPECT_TRUE(bounds(Builder().done()).box.is_empty());
  EXPECT_EQ(
      bounds(
          Builder().open(NodeKind::kIntersection).add(Sphere{.r = 0}, true).add(unit_cube()).done())
          .box,
      (Box{{0, 0, 0}, {1, 1, 1}}))
      << "what is under % is no operand";
}

TEST(Bounds, TransformedCurvesAreExact) {
  // Sampled on the surface, each of the six sides of the box is nearly touched and never crossed.
  EXPECT_TRUE(rc::check([] {
    const auto number = [] { return *rc::gen::inRange(-1000, 1000) / 100.0; };
    Affine map;
    for (Vec3& row : map.row) row = {number(), number(), number()};
    for (int i = 0; i < 3; ++i) map.row[i][i] += map.row[i][i] < 0 ? -25 : 25;
    map.translation = {number(), number(), number()};
    const double r1 = *rc::gen::inRange(0, 300) / 100.0;
    const Cylinder cylinder{.h = 2, .r1 = r1, .r2 = 1, .center = true};
    const bool is_sphere = *rc::gen::arbitrary<bool>();
    const Shape shape = is_sphere ? Shape{Sphere{.r = 2}} : Shape{cylinder};
    const Box box = bounds(Builder().transform(map).add(shape).done()).box;
    Box seen;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j < 120; ++j) {
        const double a = 3.0 * j, b = 3.0 * i;
        const double r = is_sphere ? 2 * sin_degrees(b) : i % 2 ? r1 : 1;
        const double z = is_sphere ? 2 * cos_degrees(b) : i % 2 ? -1 : 1;
        seen.include(map.point({r * cos_degrees(a), r * sin_degrees(a), z}));
      }
    const double slack = 1e-2 * box.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
      RC_ASSERT(seen.lo[axis] >= box.lo[axis] - 1e-9 && seen.lo[axis] <= box.lo[axis] + slack);
      RC_ASSERT(seen.hi[axis] <= box.hi[axis] + 1e-9 && seen.hi[axis] >= box.hi[axis] - slack);
    }
  }));
}

TEST(Bounds, FacettedSphereIsNarrowerThanTheTrueOne) {
  const Box box = bounds(Builder().add(Sphere{.r = 1, .facets = 4}).done()).box;
  EXPECT_NEAR(box.hi.x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(box.hi.z, std::sqrt(0.5), 1e-15);
}

Builder six_sides(bool general) {
  Builder builder;
  if (general)
    builder.transform({.row = {{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}}, .translation = {}});
  builder.open(NodeKind::kIntersection);
  for (const double s : {-1.0, 1.0}) {
    builder.add(Halfspace{.n = {s, 0, 0}, .d = 1});
    builder.add(Halfspace{.n = {0, 2 * s, 0}, .d = 4});
    builder.add(Halfspace{.n = {0, 0, s}, .d = 3});
  }
  return builder;
}

TEST(Bounds, SixSquareHalfspacesAreABox) {
  const Bounds square = bounds(six_sides(false).done());
  EXPECT_TRUE(square.bounded);
  EXPECT_EQ(square.box, (Box{{-1, -2, -3}, {1, 2, 3}}));
  EXPECT_FALSE(bounds(six_sides(true).done()).bounded);
}

TEST(Bounds, UnboundedHoldsFinitePrimitivesAndFeet) {
  const Bounds b = bounds(Builder()
                              .transform(shift(0, 0, 1))
                              .add(Halfspace{.n = {0, 0, 1}, .d = 4})
                              .close()
                              .add(unit_cube())
                              .done());
  EXPECT_FALSE(b.bounded);
  EXPECT_EQ(b.box, (Box{{0, 0, 0}, {1, 1, 5}}));
  EXPECT_EQ(view_region(b).center(), b.box.center());
  EXPECT_EQ(view_region(b).size(), (Vec3{5000, 5000, 5000}));
}

TEST(Bounds, HalfspaceThroughTheOriginStillHasARegion) {
  const Bounds b = bounds(Builder().add(Halfspace{.n = {1, 2, 3}, .d = 0}).done());
  EXPECT_FALSE(b.bounded);
  EXPECT_EQ(view_region(b).size(), (Vec3{1000, 1000, 1000}));
  EXPECT_EQ(tolerance(b), kRelativeTolerance);
}

TEST(Bounds, HalfspaceClipsWhatItMeets) {
  const Bounds b = bounds(Builder()
                              .open(NodeKind::kIntersection)
                              .add(Halfspace{.n = {0, 0, 1}, .d = 0.5})
                              .add(unit_cube())
                              .done());
  EXPECT_TRUE(b.bounded);
  EXPECT_EQ(b.box, (Box{{0, 0, 0}, {1, 1, 0.5}}));
}

TEST(Tolerance, ScalesWithTheLongestEdge) {
  EXPECT_EQ(tolerance({.box = {{-99, 0, 1e6}, {1, 1, 1e6 + 1}}}), 100 * kRelativeTolerance);
  EXPECT_EQ(tolerance(Bounds{}), 0);
  EXPECT_TRUE(view_region(Bounds{}).is_empty());
  const Box region = view_region({.box = {{0, 0, 0}, {1, 1, 1}}});
  EXPECT_LT(region.lo.x, 0);
  EXPECT_GT(region.lo.x, -1e-3);
}

}  // namespace
}  // namespace whittle

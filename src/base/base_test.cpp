#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "base/box.h"
#include "base/disjoint_sets.h"
#include "base/printable.h"
#include "base/result.h"

namespace whittle {
namespace {

Vec3 random_vec() {
  const auto component = [] { return *rc::gen::inRange(-1000, 1000) / 100.0; };
  return {component(), component(), component()};
}

TEST(Affine, InverseUndoesTheMap) {
  EXPECT_TRUE(rc::check([] {
    Affine a{.row = {random_vec(), random_vec(), random_vec()}, .translation = random_vec()};
    RC_PRE(std::fabs(a.determinant()) > 0.1);
    const Vec3 p = random_vec();
    RC_ASSERT(length(inverse(a).point(a.point(p)) - p) < 1e-6);
    RC_ASSERT(length((a * inverse(a)).point(p) - p) < 1e-6);
  }));
}

TEST(Affine, ProductAppliesTheRightFactorFirst) {
  const Affine move = translation({1, 0, 0}), grow = scaling({2, 2, 2});
  EXPECT_EQ((grow * move).point({0, 0, 0}), (Vec3{2, 0, 0}));
  EXPECT_EQ((move * grow).point({0, 0, 0}), (Vec3{1, 0, 0}));
}

TEST(Affine, FlatIsSingularAndThinIsNot) {
  EXPECT_TRUE(is_singular(scaling({1, 1, 0})));
  EXPECT_TRUE(is_singular(scaling({0, 0, 0})));
  EXPECT_FALSE(is_singular(scaling({1, 1, 1e-6})));
  EXPECT_FALSE(is_singular(scaling({1e-9, 1e-9, 1e-9})));
  EXPECT_TRUE(is_singular({.row = {{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}, .translation = {}}));
}

TEST(Box, TransformHoldsTheImagesOfPoints) {
  EXPECT_TRUE(rc::check([] {
    Affine a{.row = {random_vec(), random_vec(), random_vec()}, .translation = random_vec()};
    Box box;
    box.include(random_vec());
    box.include(random_vec());
    const Vec3 p = box.center();
    Box grown = transform(a, box);
    grown.lo -= Vec3{1e-9, 1e-9, 1e-9}, grown.hi += Vec3{1e-9, 1e-9, 1e-9};
    RC_ASSERT(grown.contains(a.point(p)));
  }));
}

TEST(Box, EmptyIsNeutralForUnionAndWinsIntersection) {
  const Box b{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(unite(b, Box{}), b);
  EXPECT_TRUE(intersect(b, Box{}).is_empty());
  EXPECT_TRUE(intersect(b, Box{{2, 0, 0}, {3, 1, 1}}).is_empty());
  EXPECT_TRUE(overlaps(b, Box{{1, 1, 1}, {2, 2, 2}}));
}

TEST(Printable, IsOneLineThatATerminalOnlyShows) {
  EXPECT_EQ(printable("part 1.csg"), "part 1.csg");
  EXPECT_EQ(printable("a\nb\r\x1b[31m\x7f\t"), "a?b??[31m??");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
  // U+0080 and U+009F are controls, U+00A0 and what is not UTF-8 are not.
  EXPECT_EQ(printable("\xc2\x80\xc2\x9f\xc2\xa0\xc3\x9f\x9b\xc2"), "??\xc2\xa0\xc3\x9f\x9b\xc2");
}

TEST(Result, HoldsEitherAValueOrAnError) {
  const Result<int> good = 3;
  const Result<int> bad = Error{ErrorKind::kUsage, "no"};
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 3);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "no");
}

TEST(DisjointSets, WhatIsJoinedIsOneSetThatTheLastNumberStandsFor) {
  DisjointSets sets(6);
  sets.join(0, 1);
  sets.join(2, 3);
  sets.join(1, 3);
  for (const uint32_t i : {0u, 1u, 2u, 3u}) EXPECT_EQ(sets.find(i), 3u);
  EXPECT_EQ(sets.find(4), 4u);
  EXPECT_EQ(sets.find(5), 5u);
  sets.join(3, 0);
  EXPECT_EQ(sets.find(0), 3u);
}

}  // namespace
}  // namespace whittle

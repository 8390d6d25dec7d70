#include "shape/corner_tree.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace whittle {
namespace {

using Corner = CornerTree::Corner;

Vec3 any_vector() {
  const auto any = [] { return *rc::gen::inRange(-1000, 1001) / 100.0; };
  return {any(), any(), any()};
}

/// Points spread evenly over the unit sphere, with their true normals.
std::vector<Corner> sphere(uint32_t count) {
  std::vector<Corner> corners;
  for (uint32_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Vec3 p{r * std::cos(turn), r * std::sin(turn), z};
    corners.push_back({.place = p, .normal = p, .number = i});
  }
  return corners;
}

TEST(CornerTree, VisitsEveryCornerOnceIfAllAreWanted) {
  for (const uint32_t count : {0u, 1u, 2u, 5u, 1000u}) {
    const CornerTree tree(sphere(count));
    std::multiset<uint32_t> seen;
    tree.search(
        {0, 0, 1}, {}, [](double, double) { return true; },
        [&](const Corner& corner) { seen.insert(corner.number); });
    ASSERT_EQ(seen.size(), count);
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(seen.count(i), 1u);
  }
}

TEST(CornerTree, WhatItSaysOfCornersBoundsThem) {
  // A corner may be left out only if no corner of its set is as high, or as near, as was said. So
  // asking for those above a height, or nearer than a distance, leaves out none that is.
  EXPECT_TRUE(rc::check([] {
    std::vector<Corner> corners(*rc::gen::inRange<size_t>(1, 200));
    const Vec3 away = any_vector() * 1e5;
    for (Corner& corner : corners) {
      // Places in a plane and in a line too, and normals that have nothing to do with them.
      const Vec3 p = any_vector();
      corner = {.place = away + Vec3{p.x, std::floor(p.y / 5), 0}, .normal = any_vector()};
    }
    const Vec3 n = normalize(any_vector() + Vec3{0.001, 0, 0}), from = away + any_vector();
    const CornerTree tree(corners);
    const double height = dot(n, corners[0].place), distance = length(corners[0].place - from);
    size_t high = 0, near = 0, expected_high = 0, expected_near = 0;
    for (const Corner& corner : corners) {
      expected_high += dot(n, corner.place) >= height;
      expected_near += length(corner.place - from) <= distance;
    }
    tree.search(
        n, from, [&](double most, double) { return most >= height; },
        [&](const Corner& corner) { high += dot(n, corner.place) >= height; });
    tree.search(
        n, from, [&](double, double least) { return least <= distance; },
        [&](const Corner& corner) { near += length(corner.place - from) <= distance; });
    RC_ASSERT(high == expected_high);
    RC_ASSERT(near == expected_near);
  }));
}

TEST(CornerTree, FindsTheHighestOfManyAmongFew) {
  constexpr uint32_t kCount = 100'000;
  const std::vector<Corner> corners = sphere(kCount);
  const CornerTree tree(corners);
  size_t visited = 0;
  constexpr size_t kSearches = 100;
  for (size_t i = 0; i < kSearches; ++i) {
    const Vec3 n = corners[i * (kCount / kSearches)].place;
    double highest = -std::numeric_limits<double>::infinity();
    tree.search(
        n, {}, [&](double most, double) { return most > highest; },
        [&](const Corner& corner) {
          ++visited;
          highest = std::max(highest, dot(n, corner.place));
        });
    EXPECT_NEAR(highest, 1, 1e-15);
  }
  EXPECT_LT(visited / kSearches, 50u);
}

}  // namespace
}  // namespace whittle

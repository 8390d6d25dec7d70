#include "csg/polish.h"

#include <cstdlib>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/degrees.h"

namespace whittle {
namespace {

/// As OpenSCAD prints it.
Affine printed(Affine m) {
  const auto six = [](double x) { return std::strtod(fmt::format("{:.6g}", x).c_str(), nullptr); };
  for (Vec3& row : m.row) row = {six(row.x), six(row.y), six(row.z)};
  m.translation = {six(m.translation.x), six(m.translation.y), six(m.translation.z)};
  return m;
}

Affine about(int axis, double degrees) {
  Affine m;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  m.row[u][u] = m.row[v][v] = cos_degrees(degrees);
  m.row[v][u] = sin_degrees(degrees);
  m.row[u][v] = -m.row[v][u];
  return m;
}

Affine openscad_rotation(double a, double b, double c) {
  return about(2, c) * about(1, b) * about(0, a);
}

double difference(const Affine& a, const Affine& b) {
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, max_component(abs(a.row[i] - b.row[i])));
  return most;
}

TEST(Polished, AnglesTypedByPeopleComeBackToTheBit) {
  for (const double degrees : {0.0, 30.0, 45.0, 60.0, 90.0, 180.0, 17.0, 22.5, 0.25, -33.33, 359.0})
    for (int axis = 0; axis < 3; ++axis) {
      const Affine exact = about(axis, degrees);
      EXPECT_LT(difference(polished(printed(exact)), exact), 3e-16) << degrees << ' ' << axis;
    }
  EXPECT_EQ(polished(printed(about(2, 30))).row[0].y, -0.5);
}

TEST(Polished, SoDoThreeAnglesAtOnceMirroredOrNot) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> angle(-18000, 18000);
  for (int i = 0; i < 2000; ++i) {
    const Affine turn =
        openscad_rotation(angle(random) / 100.0, angle(random) / 100.0, angle(random) / 100.0);
    const Affine mirrored = turn * scaling({1, i % 2 == 0 ? -1.0 : 1.0, 1});
    EXPECT_LT(difference(polished(printed(mirrored)), mirrored), 1e-15);
  }
  for (const double c : {0.0, 10.0, 77.7})
    for (const double b : {90.0, -90.0})
      EXPECT_LT(
          difference(polished(printed(openscad_rotation(0, b, c))), openscad_rotation(0, b, c)),
          1e-15);
}

TEST(Polished, AnyOtherRotationBecomesTheNearest) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> angle(-180, 180);
  double before = 0, after = 0;
  for (int i = 0; i < 2000; ++i) {
    const Affine turn = openscad_rotation(angle(random), angle(random), angle(random));
    const Affine raw = printed(turn), smooth = polished(raw);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(dot(smooth.row[j], smooth.row[k]), j == k, 1e-15);
    EXPECT_LE(difference(smooth, raw), 1e-6);
    for (int j = 0; j < 3; ++j) {
      before += dot(raw.row[j] - turn.row[j], raw.row[j] - turn.row[j]);
      after += dot(smooth.row[j] - turn.row[j], smooth.row[j] - turn.row[j]);
    }
  }
  EXPECT_LT(after, 0.5 * before);
}

TEST(Polished, WhatIsNoRotationStays) {
  for (const Affine& map :
       {scaling({1, 1, 1.00001}), scaling({2, 2, 2}), scaling({0, 0, 0}),
        Affine{.row = {{1, 1e-5, 0}, {0, 1, 0}, {0, 0, 1}}, .translation = {}},
        Affine{.row = {{1, 0, 3e-6}, {0, 1, 0}, {0, 0, 1}}, .translation = {}},
        Affine{.row = {{1, NAN, 0}, {0, 1, 0}, {0, 0, 1}}, .translation = {}}}) {
    const Affine same = polished(map);
    EXPECT_EQ(same.row[0].x, map.row[0].x);
    EXPECT_TRUE(same == map || std::isnan(map.row[0].y));
  }
}

TEST(Polished, SmallEntriesHaveSmallLastDigits) {
  // A hundred-thousandth of a degree is not none: 1.74533e-07 is not printed for 0.
  for (const double degrees : {1e-5, 2e-5, 1e-3, 0.0149}) {
    const Affine turn = about(1, degrees);
    EXPECT_LT(difference(polished(printed(turn)), turn), 1e-9) << degrees;
  }
}

TEST(Polished, TheTranslationIsLeftAlone) {
  Affine map = printed(about(0, 12.345));
  map.translation = {1.23456, -7, 1e6};
  EXPECT_EQ(polished(map).translation, map.translation);
}

TEST(Polished, MoreThanSixDigitsAreMeantAsTheyStand) {
  // A ten-thousandth of a degree away from 30: prints as 30 would, but was not printed.
  const Affine turn = about(2, 30.00001);
  EXPECT_EQ(polished(turn), turn);
  EXPECT_EQ(polished(printed(turn)), about(2, 30));
}

}  // namespace
}  // namespace whittle

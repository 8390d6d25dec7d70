#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flat/outlines.h"
#include "flat/polygons_for_test.h"
#include "flat/sweep_work.h"

namespace whittle {
namespace {

std::string entities(const std::string& text) {
  return "0\nSECTION\n2\nENTITIES\n" + text + "0\nENDSEC\n0\nEOF\n";
}

Polygons read(const std::string& content, const Import& how = {}) {
  const Result<Polygons> polygons = read_dxf(content, how, [](const auto&, const auto&) {});
  EXPECT_TRUE(polygons);
  return polygons ? *polygons : Polygons{};
}

std::string line(double x0, double y0, double x1, double y1) {
  const auto number = [](double x) { return std::to_string(x) + "\n"; };
  return "  0\r\nLINE\r\n  8\n0\n 10\n" + number(x0) + " 20\n" + number(y0) + " 11\n" + number(x1) +
         " 21\n" + number(y1);
}

TEST(Dxf, LinesAreJoinedInAnyOrder) {
  const std::string square =
      line(0, 0, 4, 0) + line(0, 3, 0, 0) + line(4, 3, 4, 0) + line(4.000004, 3, 0, 3);
  EXPECT_NEAR(area(read(entities(square))), 12, 1e-4);
  // Origin first, then scale.
  Import how;
  how.origin = {1, 1};
  how.scale = 2;
  const Polygons moved = read(entities(square), how);
  EXPECT_NEAR(area(moved), 48, 1e-3);
  EXPECT_NEAR(bounds(moved).lo.x, -2, 1e-9);
}

TEST(Dxf, OpenPathsAreClosedAndRingsInRingsAreHoles) {
  EXPECT_NEAR(area(read(entities(line(0, 0, 4, 0) + line(4, 0, 4, 4)))), 8, 1e-9);
  std::string rings;
  for (const double r : {4.0, 2.0})
    rings += line(-r, -r, r, -r) + line(r, -r, r, r) + line(r, r, -r, r) + line(-r, r, -r, -r);
  EXPECT_NEAR(area(read(entities(rings))), 64 - 16, 1e-9);
}

TEST(Dxf, CurvesHaveOpenScadsFragments) {
  const std::string circle = entities("0\nCIRCLE\n8\n0\n10\n1\n20\n2\n40\n5\n");
  // 2 pi 5 / $fs = 15.7 fragments.
  ASSERT_EQ(read(circle).contours.size(), 1u);
  EXPECT_EQ(read(circle).contours[0].size(), 16u);
  Import fine;
  fine.fragments.fn = 100;
  EXPECT_EQ(read(circle, fine).contours[0].size(), 100u);
  // A quarter: four of sixteen, and the way back.
  const std::string arc = entities("0\nARC\n8\n0\n10\n0\n20\n0\n40\n5\n50\n270\n51\n0\n");
  ASSERT_EQ(read(arc).contours.size(), 1u);
  EXPECT_EQ(read(arc).contours[0].size(), 5u);
  const std::string ellipse = entities(
      "0\nELLIPSE\n8\n0\n10\n0\n20\n0\n11\n0\n21\n10\n40\n0.5\n41\n0\n42\n6.283185307179586\n");
  EXPECT_NEAR(bounds(read(ellipse)).hi.y, 10, 1e-9);
  EXPECT_NEAR(bounds(read(ellipse)).hi.x, 5, 0.1);
}

TEST(Dxf, PolylinesAndLayers) {
  const std::string triangle =
      "0\nLWPOLYLINE\n8\nA\n90\n3\n70\n1\n10\n0\n20\n0\n10\n4\n20\n0\n10\n4\n20\n2\n";
  EXPECT_NEAR(area(read(entities(triangle))), 4, 1e-12);
  Import other;
  other.layer = "B";
  EXPECT_TRUE(read(entities(triangle), other).is_empty());
  other.layer = "A";
  EXPECT_NEAR(area(read(entities(triangle), other)), 4, 1e-12);
}

TEST(Dxf, BlocksAreInserted) {
  const std::string square =
      "0\nLWPOLYLINE\n8\n0\n70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n2\n10\n0\n20\n2\n";
  const std::string blocks = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nS\n" + square +
                             "0\nINSERT\n2\nS\n10\n9\n20\n9\n0\nENDBLK\n0\nENDSEC\n";
  const std::string insert = "0\nINSERT\n8\n0\n2\nS\n10\n10\n20\n0\n50\n90\n41\n3\n";
  const Polygons found = read(blocks + entities(insert));
  EXPECT_NEAR(area(found), 12, 1e-9);
  EXPECT_NEAR(bounds(found).lo.x, 8, 1e-9);
  EXPECT_NEAR(bounds(found).hi.y, 6, 1e-9);
}

TEST(Dxf, TanglesAreRefused) {
  std::string tangle;
  const auto at = [](int i) { return Vec2{double(i * 7919 % 2003), double(i * 104'729 % 1009)}; };
  for (int i = 0; i < 2000; ++i) tangle += line(at(i).x, at(i).y, at(i + 1).x, at(i + 1).y);
  const Result<Polygons> polygons = read_dxf(entities(tangle), {}, [](const auto&, const auto&) {});
  ASSERT_FALSE(polygons);
  EXPECT_EQ(polygons.error().message, kTooTangled);
}

TEST(Dxf, WhatIsNoDrawingIsRefusedOrEmpty) {
  EXPECT_FALSE(read_dxf("hello", {}, [](const auto&, const auto&) {}));
  EXPECT_FALSE(read_dxf("", {}, [](const auto&, const auto&) {}));
  EXPECT_TRUE(read(entities(line(0, 0, 1e308, -1e308) + line(NAN, 0, 1, 1))).is_empty());
  int remarks = 0;
  const std::string splines = entities("0\nSPLINE\n8\n0\n0\nSPLINE\n8\n0\n");
  EXPECT_TRUE(read_dxf(splines, {}, [&](const auto&, const auto&) { ++remarks; }));
  EXPECT_EQ(remarks, 1);
  // Blocks of blocks of blocks.
  std::string bomb = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB0\n" + line(0, 0, 1, 0) + "0\nENDBLK\n";
  for (int i = 1; i < 40; ++i) {
    bomb += "0\nBLOCK\n2\nB" + std::to_string(i) + "\n";
    for (int k = 0; k < 2; ++k)
      bomb += "0\nINSERT\n2\nB" + std::to_string(i - 1) + "\n10\n0\n20\n0\n";
    bomb += "0\nENDBLK\n";
  }
  EXPECT_FALSE(read_dxf(bomb + "0\nENDSEC\n", {}, [](const auto&, const auto&) {}));
}

}  // namespace
}  // namespace whittle

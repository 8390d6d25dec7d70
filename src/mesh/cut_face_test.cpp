#include "mesh/cut_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

namespace whittle {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// How much more often an edge is run through upward than downward.
using Balance = std::map<std::pair<uint32_t, uint32_t>, int>;

void run_along(Balance& balance, uint32_t a, uint32_t b, int times) {
  if (a == b) return;
  const auto edge = std::minmax(a, b);
  if ((balance[edge] += a < b ? times : -times) == 0) balance.erase(edge);
}

/// The triangles' edges without those of the loop.
Balance left_over(const std::vector<uint32_t>& loop, const Triangles& triangles) {
  Balance balance;
  for (size_t i = 0; i < loop.size(); ++i)
    run_along(balance, loop[i], loop[(i + 1) % loop.size()], -1);
  for (const auto& t : triangles)
    for (size_t e = 0; e < 3; ++e) run_along(balance, t[e], t[(e + 1) % 3], 1);
  return balance;
}

Triangles cut(const std::vector<Vec3>& points, const std::vector<uint32_t>& loop) {
  Triangles triangles;
  cut_face(points, loop, triangles);
  EXPECT_EQ(left_over(loop, triangles), Balance{});
  return triangles;
}

TEST(CutFace, FlatLoopsAreCoveredOnce) {
  // Stars, in planes of all directions: as many corners as few and as many take.
  for (const int corners : {4, 6, 10, 32, 34, 100, 3000})
    for (int turn = 0; turn < 6; ++turn) {
      std::vector<Vec3> points;
      Vec3 expected;
      for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners, r = k % 2 ? 1 : 3;
        const Vec3 p{r * std::cos(angle), r * std::sin(angle), 0};
        points.push_back(
            {p[turn % 3], p[(turn + (turn < 3 ? 1 : 2)) % 3], p[(turn + (turn < 3 ? 2 : 1)) % 3]});
      }
      std::vector<uint32_t> loop(points.size());
      std::iota(loop.begin(), loop.end(), 0);
      for (size_t k = 0; k < points.size(); ++k)
        expected += cross(points[k], points[(k + 1) % points.size()]) * 0.5;
      double sum = 0;
      for (const auto& [a, b, c] : cut(points, loop))
        sum += length(cross(points[b] - points[a], points[c] - points[a])) * 0.5;
      EXPECT_NEAR(sum, length(expected), 1e-9) << corners << " " << turn;
    }
}

TEST(CutFace, AnyLoopAtAllStaysClosed) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (int i = 0; i < 3000; ++i) {
    std::vector<Vec3> points;
    const int count = 3 + below(40), range = 1 + below(5);
    for (int k = 0; k < count; ++k)
      points.push_back({double(below(range)), double(below(range)), double(below(range))});
    std::vector<uint32_t> loop;
    for (int k = 3 + below(i % 2 ? 12 : 80); k > 0; --k) loop.push_back(uint32_t(below(count)));
    cut(points, loop);
  }
}

TEST(CutFace, VeryLongLoopsAreCutQuickly) {
  std::vector<Vec3> points;
  for (int k = 0; k < 50'000; ++k) {
    const double angle = 1e-3 * k, r = 1 + 1e-5 * k;
    points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  std::vector<uint32_t> loop(points.size());
  std::iota(loop.begin(), loop.end(), 0);
  // And back in the spiral's gaps.
  for (size_t k = points.size(); k-- > 0;) {
    loop.push_back(uint32_t(points.size()));
    points.push_back(points[k] * 1.001);
  }
  EXPECT_GE(cut(points, loop).size(), loop.size() - 2);
}

}  // namespace
}  // namespace whittle

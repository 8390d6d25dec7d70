#include "subdivide/linear_program.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace whittle {
namespace {

constexpr Vec3 kUnit{1, 1, 1};

Constraint plane(Vec3 n, double d) {
  return {normalize(n), d / length(n)};
}

TEST(LinearProgram, WithoutConstraintsItIsACornerOfTheBox) {
  const auto p = farthest_point({0, 0, 1}, {}, {1, 2, 3});
  ASSERT_TRUE(p);
  EXPECT_EQ(p->z, 3);
}

TEST(LinearProgram, ThreePlanesMeetInACorner) {
  // x + y + z <= 0.6 with x, y >= 0.1.
  const std::vector<Constraint> planes{plane({1, 1, 1}, 0.6), plane({-1, 0, 0}, -0.1),
                                       plane({0, -1, 0}, -0.1)};
  const auto p = farthest_point({0, 0, 1}, planes, kUnit);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 0.1, 1e-15);
  EXPECT_NEAR(p->y, 0.1, 1e-15);
  EXPECT_NEAR(p->z, 0.4, 1e-15);
}

TEST(LinearProgram, PlanesThatExcludeOneAnotherLeaveNothing) {
  EXPECT_FALSE(farthest_point(
      {0, 0, 1}, std::vector{plane({1, 1, 0}, -0.1), plane({-1, -1, 0}, -0.1)}, kUnit));
  EXPECT_FALSE(farthest_point({0, 0, 1}, std::vector{plane({1, 0, 0}, -1.5)}, kUnit));
  // A tetrahedron turned inside out.
  EXPECT_FALSE(farthest_point({1, 0, 0},
                              std::vector{plane({-1, 0, 0}, -0.2), plane({0, -1, 0}, -0.2),
                                          plane({0, 0, -1}, -0.2), plane({1, 1, 1}, 0.5)},
                              kUnit));
}

/// The largest objective among all points where three of the constraints and sides meet and that
/// fulfil the rest: what a linear program is, in the slowest way.
double by_enumeration(Vec3 objective, std::vector<Constraint> all) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Constraint side{{}, 1};
      side.n[axis] = sign;
      all.push_back(side);
    }
  double best = -INFINITY;
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      for (size_t k = 0; k < j; ++k) {
        const Vec3 jk = cross(all[j].n, all[k].n);
        const double det = dot(all[i].n, jk);
        if (std::fabs(det) < 1e-9) continue;
        const Vec3 p = (jk * all[i].d + cross(all[k].n, all[i].n) * all[j].d +
                        cross(all[i].n, all[j].n) * all[k].d) /
                       det;
        bool inside = true;
        for (const Constraint& c : all) inside = inside && dot(c.n, p) <= c.d + 1e-9;
        if (inside) best = std::max(best, dot(objective, p));
      }
  return best;
}

RC_GTEST_PROP(LinearProgram, EqualsTheBestOfAllVertices, ()) {
  const auto number = [](int scale) { return *rc::gen::inRange(-100, 101) / double(scale); };
  std::vector<Constraint> planes;
  const int count = *rc::gen::inRange(0, 12);
  for (int i = 0; i < count; ++i) {
    const Vec3 n{number(100), number(100), number(100)};
    if (length(n) > 0.1) planes.push_back(plane(n, number(150)));
  }
  Vec3 objective{};
  objective[*rc::gen::inRange(0, 3)] = *rc::gen::element(-1.0, 1.0);
  const double expected = by_enumeration(objective, planes);
  const auto found = farthest_point(objective, planes, kUnit);
  // What is feasible by a hair may be found either way.
  std::vector<Constraint> tighter = planes;
  for (Constraint& c : tighter) c.d -= 1e-7;
  if (std::isinf(by_enumeration(objective, tighter))) return;
  RC_ASSERT(found.has_value());
  RC_ASSERT(std::fabs(dot(objective, *found) - expected) < 1e-9);
  for (const Constraint& c : planes) RC_ASSERT(dot(c.n, *found) <= c.d + 1e-9);
}

}  // namespace
}  // namespace whittle

#include "lower/face_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "lower/primitive_faces.h"

namespace whittle {
namespace {

constexpr double kSieveTolerance = 1e-6;

struct SievedFace {
  HalfSpace half_space;
  Reach reach;
};

struct Dice {
  std::mt19937_64 bits{7};
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(bits); }
  Vec3 vector() { return {unit(), unit(), unit()}; }
};

SievedFace plane_face(Vec3 n, double offset, Vec3 center, double radius, double tolerance) {
  n = normalize(n);
  return {{n * offset, {{}, {}, n * 0.5, 0}, SurfaceKind::kPlane},
          {center, radius, radius, tolerance, 0}};
}

SievedFace ball_face(Vec3 center, double r, double tolerance) {
  LoweredPrimitive lowered;
  lower_primitive(Sphere{r, 0}, translation(center), lowered);
  const Extent& e = lowered.extent;
  return {lowered.half_spaces[0], {e.center, e.radius, e.width, tolerance, e.radius}};
}

/// A round tube along z.
SievedFace wall_face(Vec3 center, double r, double tolerance) {
  LoweredPrimitive lowered;
  lower_primitive(Cylinder{r, r, r, true, 0}, translation(center), lowered);
  const Extent& e = lowered.extent;
  return {lowered.half_spaces[0], {e.center, e.radius, e.width, tolerance, 0}};
}

bool is_ball(const SievedFace& face) {
  return face.reach.ball_reach > 0;
}

/// Whether two planes may be one over the reach of either.
bool are_near_planes(const SievedFace& a, const SievedFace& b) {
  const Vec3 n = a.half_space.f.b * 2.0;
  for (const double sign : {1.0, -1.0}) {
    const Vec3 m = b.half_space.f.b * (2.0 * sign);
    for (const Reach& reach : {a.reach, b.reach}) {
      const Vec3 foot = reach.center - m * dot(m, reach.center - b.half_space.center);
      if (std::fabs(dot(n, foot - a.half_space.center)) + length(n - m) * reach.radius <=
          reach.tolerance)
        return true;
    }
  }
  return false;
}

bool are_near(const SievedFace& a, const SievedFace& b) {
  if (a.half_space.is_plane() != b.half_space.is_plane() || is_ball(a) != is_ball(b)) return false;
  if (a.half_space.is_plane()) return are_near_planes(a, b);
  const Vec3 way = a.half_space.center - b.half_space.center;
  // A wall goes on along z; its width is that of the tube.
  const double off = is_ball(a)
                         ? length(way)
                         : std::hypot(way.x, way.y) + std::fabs(a.reach.width - b.reach.width) / 2;
  return off <= std::max(a.reach.tolerance, b.reach.tolerance);
}

std::vector<uint32_t> sieved(const std::vector<SievedFace>& faces, const Workers* workers) {
  FaceSieve sieve(1, kSieveTolerance, faces.size());
  std::vector<HalfSpace> half_spaces;
  for (uint32_t i = 0; i < faces.size(); ++i) {
    half_spaces.push_back(faces[i].half_space);
    sieve.set(i, faces[i].half_space, faces[i].reach);
  }
  return sieve.with_others(
      half_spaces, [&](uint32_t face) -> const Reach& { return faces[face].reach; }, workers);
}

/// One near another.
SievedFace neighbour(const SievedFace& of, double radius, double tolerance, Dice& dice) {
  const HalfSpace& h = of.half_space;
  if (h.is_plane()) {
    const Vec3 n = normalize(h.f.b * 2.0 + dice.vector() * (tolerance / radius));
    const double offset = dot(n, h.center) + 2 * kSieveTolerance * dice.unit();
    const Vec3 place = dice.vector() * (1 - radius);
    const double side = dice.unit() < 0 ? -1 : 1;
    return plane_face(n * side, offset * side, place - n * (dot(n, place) - offset), radius,
                      tolerance);
  }
  const Vec3 center = h.center + dice.vector() * of.reach.tolerance;
  const double r = of.reach.width / 2;
  if (is_ball(of)) return ball_face(center, r, of.reach.tolerance);
  return wall_face({center.x, center.y, dice.unit()}, r + 0.5 * of.reach.tolerance * dice.unit(),
                   of.reach.tolerance);
}

/// Planes, balls and walls, many of which have one near them; planes turned the same way or not.
std::vector<SievedFace> mixed_faces(size_t count) {
  Dice dice;
  std::vector<SievedFace> faces;
  while (faces.size() < count) {
    const double radius = std::pow(10, -1.5 * std::fabs(dice.unit()));
    const double tolerance = std::min(kSieveTolerance, 1e-3 * radius);
    if (faces.size() > 2 && dice.unit() < -0.4) {
      faces.push_back(neighbour(faces[dice.bits() % faces.size()], radius, tolerance, dice));
    } else if (faces.size() % 3 == 0) {
      faces.push_back(ball_face(dice.vector(), 0.1 * radius, tolerance));
    } else if (faces.size() % 3 == 1) {
      faces.push_back(wall_face(dice.vector(), 0.1 * radius, tolerance));
    } else {
      // The direction by which planes are turned one way has one sign on both sides of some.
      const Vec3 any = dice.vector();
      const Vec3 n = faces.size() % 5 == 0 ? cross(any, Vec3{0.8117, 0.4733, 0.3421}) : any;
      const double offset = dice.unit();
      const Vec3 place = dice.vector() * (1 - radius), unit = normalize(n);
      faces.push_back(
          plane_face(n, offset, place - unit * (dot(unit, place) - offset), radius, tolerance));
    }
  }
  return faces;
}

TEST(FaceSieve, NothingNearIsPassedOver) {
  const std::vector<SievedFace> faces = mixed_faces(4000);
  const std::vector<uint32_t> found = sieved(faces, nullptr);
  size_t near = 0;
  for (uint32_t i = 0; i < faces.size(); ++i) {
    for (uint32_t k = 0; k < i; ++k) {
      if (!are_near(faces[i], faces[k])) continue;
      ++near;
      EXPECT_TRUE(std::ranges::binary_search(found, i)) << i << " is near " << k;
      EXPECT_TRUE(std::ranges::binary_search(found, k)) << k << " is near " << i;
    }
  }
  EXPECT_GT(near, 300u);
  EXPECT_LT(found.size(), 4 * faces.size() / 5);
}

TEST(FaceSieve, AnyNumberOfThreadsFindsTheSame) {
  const std::vector<SievedFace> faces = mixed_faces(60'000);
  const std::vector<uint32_t> found = sieved(faces, nullptr);
  for (const int threads : {2, 4}) {
    const Workers workers(threads);
    EXPECT_EQ(sieved(faces, &workers), found);
  }
}

TEST(FaceSieve, WhatStandsFarApartStandsAlone) {
  std::vector<SievedFace> faces;
  for (uint32_t i = 0; i < 5000; ++i) {
    // On a spiral over the half sphere, a thousand slacks from turn to turn.
    const double z = (i + 0.5) / 5000, turn = i * 2.399963229728653, r = std::sqrt(1 - z * z);
    const Vec3 n{r * std::cos(turn), r * std::sin(turn), z};
    faces.push_back(plane_face(n, 0.9 * std::sin(i * 0.7), {}, 1, kSieveTolerance));
    faces.push_back(ball_face(n, 0.01, kSieveTolerance));
  }
  EXPECT_EQ(sieved(faces, nullptr).size(), 0u);
}

// Where numbers end, what is equal is near.
TEST(FaceSieve, WhatIsFarOffIsFound) {
  for (const double far : {1e14, 1e200, 1e300}) {
    const std::vector<SievedFace> faces = {
        plane_face({0, 0, 1}, far, {}, 1, kSieveTolerance),
        plane_face({0, 0, -1}, -far, {}, 1, kSieveTolerance),
        plane_face({0, 0, 1}, 0.5, {}, 1, kSieveTolerance),
        ball_face({far, 0, 0}, 1, kSieveTolerance),
        ball_face({far, 0, 0}, 1, kSieveTolerance),
        ball_face({0, 0, 0}, 1, kSieveTolerance),
    };
    EXPECT_EQ(sieved(faces, nullptr), (std::vector<uint32_t>{0, 1, 3, 4})) << far;
  }
}

// One that is so loose that any other may lie on it finds all of its kind.
TEST(FaceSieve, WhatIsAsLooseAsTheRegionIsNearAll) {
  Dice dice;
  std::vector<SievedFace> faces;
  for (int i = 0; i < 100; ++i)
    faces.push_back(plane_face(dice.vector(), dice.unit(), {}, 1, kSieveTolerance));
  faces.push_back(plane_face({0, 0, 1}, 0, {}, 1e-15, 1));
  faces.push_back(ball_face({}, 0.5, kSieveTolerance));
  const std::vector<uint32_t> found = sieved(faces, nullptr);
  ASSERT_EQ(found.size(), 101u);
  EXPECT_EQ(found.back(), 100u);
}

}  // namespace
}  // namespace whittle

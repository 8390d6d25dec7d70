#include "lower/plane_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace whittle {
namespace {

constexpr double kOffsetSlack = 1e-3, kNormalSlack = 1e-5;

PlanePlace flipped(const PlanePlace& plane) {
  return {-plane.n, -plane.offset};
}

bool are_near(const PlanePlace& a, const PlanePlace& b) {
  const auto near_as_turned = [&](const PlanePlace& c) {
    return std::fabs(a.offset - c.offset) <= kOffsetSlack &&
           max_component(abs(a.n - c.n)) <= kNormalSlack;
  };
  return near_as_turned(b) || near_as_turned(flipped(b));
}

/// Planes, many of which have one near them, turned the same way or not.
std::vector<PlanePlace> planes(size_t n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<PlanePlace> all;
  while (all.size() < n) {
    PlanePlace plane{normalize(Vec3{any(random), any(random), any(random)}), 20 * any(random)};
    if (all.size() % 3 == 0) plane.n = {0, 0, 1};
    // The direction by which planes are turned one way has one sign on both sides of these.
    if (all.size() % 7 == 0) plane.n = normalize(cross(plane.n, Vec3{0.8117, 0.4733, 0.3421}));
    if (!all.empty() && any(random) < 0) {
      plane = all[random() % all.size()];
      plane.n = normalize(plane.n + Vec3{any(random), any(random), any(random)} * kNormalSlack);
      plane.offset += 1.5 * kOffsetSlack * any(random);
    }
    all.push_back(any(random) < 0 ? flipped(plane) : plane);
  }
  return all;
}

TEST(PlaneSieve, NothingNearIsPassedOver) {
  const std::vector<PlanePlace> all = planes(3000);
  PlaneSieve sieve(kOffsetSlack, kNormalSlack);
  std::set<uint32_t> taken;
  int with_others = 0, alone = 0;
  for (uint32_t i = 0; i < all.size(); ++i) {
    const bool any = sieve.take_near(all[i], [&](uint32_t number) { taken.insert(number); });
    bool is_alone = true;
    for (uint32_t k = 0; k < i; ++k) {
      if (!are_near(all[i], all[k])) continue;
      is_alone = false;
      EXPECT_TRUE(taken.contains(k)) << k << " is near " << i;
    }
    if (!is_alone) {
      EXPECT_TRUE(any) << i;
    }
    ++(any ? with_others : alone);
    if (!sieve.add(all[i], i)) taken.insert(i);
  }
  EXPECT_GT(with_others, 1000);
  EXPECT_GT(alone, 1000);
}

// Where doubles cannot tell parts of a cell apart any more, all on one side is near.
TEST(PlaneSieve, NothingIsToldApartFartherThanDoublesCan) {
  const Vec3 up{0, 0, 1};
  const double cell = 16 * kOffsetSlack;
  for (const double far : {2e15 * cell, 1e300}) {
    PlaneSieve sieve(kOffsetSlack, kNormalSlack);
    EXPECT_TRUE(sieve.add({up, far}, 0));
    EXPECT_FALSE(sieve.take_near({up, 1}, [](uint32_t) {}));
    EXPECT_FALSE(sieve.take_near({up, -far}, [](uint32_t) {}));
    EXPECT_TRUE(sieve.take_near({-up, -1.5 * far}, [](uint32_t) {}));
  }
}

TEST(PlaneSieve, PlanesThatStandFarApartStandAlone) {
  PlaneSieve sieve(kOffsetSlack, kNormalSlack);
  int others = 0;
  for (uint32_t i = 0; i < 5000; ++i) {
    // On a spiral over the half sphere, a thousand slacks from turn to turn.
    const double z = (i + 0.5) / 5000, turn = i * 2.399963229728653, r = std::sqrt(1 - z * z);
    const PlanePlace plane{{r * std::cos(turn), r * std::sin(turn), z}, 3 * std::sin(i * 0.7)};
    others += sieve.take_near(plane, [](uint32_t) {});
    EXPECT_TRUE(sieve.add(plane, i));
  }
  EXPECT_EQ(others, 0);
}

}  // namespace
}  // namespace whittle

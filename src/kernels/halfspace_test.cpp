#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <random>

#include "kernels/kernels.h"

namespace whittle {
namespace {

using K = Kernels<double>;

/// Log-uniform magnitudes with both signs, and a spicy value now and then.
struct Numbers {
  std::mt19937_64 engine;
  explicit Numbers(uint64_t seed) : engine(seed) {}
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine);
  }
  double any() {
    static constexpr double kSpicy[] = {0, -0.0, 1, -1, 0.5, 2, -2, 1e-300};
    if (engine() % 4 == 0) return kSpicy[engine() % 8];
    return (engine() % 2 ? 1 : -1) * std::exp(uniform(-12, 12));
  }
  Vec3 vec() { return {any(), any(), any()}; }
  K::Quadric quadric() { return {vec(), vec(), vec(), any()}; }
};

TEST(QuadraticRoot, IsWhereTheSignChanges) {
  Numbers numbers(1);
  int checked = 0;
  for (int i = 0; i < 200000; ++i) {
    const double a = numbers.any(), h = numbers.any(), k = numbers.any();
    if (h * h - a * k <= 1e-12 * (h * h + std::fabs(a * k))) continue;
    for (const bool rising : {false, true}) {
      if (a == 0 && (h > 0) != rising) continue;  // a line has one root
      const double t = K::quadratic_root(a, h, k, rising);
      const double step = 1e-4 * std::fabs(t);
      const double before = K::quadratic_value(a, h, k, t - step),
                   after = K::quadratic_value(a, h, k, t + step);
      // Rounding blurs the sign where the step is small against the other root.
      const double blur = 1e-13 * (std::fabs(a * t * t) + std::fabs(2 * h * t) + std::fabs(k));
      const double to_vertex = a == 0 ? INFINITY : std::fabs(t + h / a);
      if (std::fabs(before) <= blur || std::fabs(after) <= blur || to_vertex <= step) continue;
      ++checked;
      ASSERT_EQ(before < 0, rising) << a << ' ' << h << ' ' << k << " at " << t;
      ASSERT_EQ(after > 0, rising) << a << ' ' << h << ' ' << k << " at " << t;
    }
  }
  EXPECT_GT(checked, 100000);
}

TEST(QuadraticRoot, KeepsItsDigitsBesideAHugeOne) {
  // (t - 1e-9)(t - 1e9): the textbook formula loses the small root altogether.
  const double h = -0.5 * (1e9 + 1e-9);
  EXPECT_NEAR(K::quadratic_root(1, h, 1, false), 1e-9, 1e-23);
  EXPECT_NEAR(K::quadratic_root(1, h, 1, true), 1e9, 1e-5);
}

TEST(QuadraticRoot, OfALineIsItsOnlyOne) {
  for (const double zero : {0.0, -0.0}) {
    EXPECT_EQ(K::quadratic_root(zero, 1, -4, true), 2);
    EXPECT_EQ(K::quadratic_root(zero, -1, 4, false), 2);
  }
}

TEST(Quadric, RangeOfASphereHoldsEveryValue) {
  Numbers numbers(5);
  for (int i = 0; i < 50000; ++i) {
    const double scale = std::fabs(numbers.any()), c = -std::fabs(numbers.any());
    const K::Quadric f{{scale, scale, scale}, {}, {}, c};
    const Vec3 m = numbers.vec(), h = abs(numbers.vec());
    const K::Vec2 range = K::sphere_range(scale, c, m, h, 1e-14);
    for (int j = 0; j < 4; ++j) {
      const auto weight = [&] { return numbers.engine() % 2 ? numbers.uniform(-1, 1) : 1.0; };
      const Vec3 p{m.x + h.x * weight(), m.y + h.y * weight(), m.z + h.z * weight()};
      ASSERT_LE(range.x, K::quadric_value(f, p));
      ASSERT_GE(range.y, K::quadric_value(f, p));
    }
  }
}

TEST(Quadric, RangeIsTightForSpheres) {
  const K::Vec2 range = K::sphere_range(1, -1, {0.25, 0, 0}, {0.5, 0.5, 0.5}, 0);
  EXPECT_DOUBLE_EQ(range.x, -1);
  EXPECT_DOUBLE_EQ(range.y, 0.75 * 0.75 + 0.25 + 0.25 - 1);
}

TEST(Quadric, AlongARayIsTheValueOnTheRay) {
  Numbers numbers(3);
  for (int i = 0; i < 20000; ++i) {
    K::Quadric f{{numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(-2, 2)},
                 {numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(-2, 2)},
                 {numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(-2, 2)},
                 numbers.uniform(-2, 2)};
    const Vec3 o{numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(-2, 2)};
    const Vec3 d = normalize(Vec3{numbers.uniform(-1, 1), numbers.uniform(-1, 1), 0.1});
    const double t = numbers.uniform(-2, 2);
    ASSERT_NEAR(K::along_value(K::quadric_along_ray(f, o, d), t), K::quadric_value(f, o + d * t),
                1e-10);
    ASSERT_NEAR(K::along_value(K::small_quadric_along_ray(f, o, d), t),
                K::quadric_value(f, o + d * t), 1e-7);
    const K::Quadric plane{{}, {}, f.b, 0};
    ASSERT_NEAR(K::along_value(K::plane_along_ray(f.b, o, d), t),
                K::quadric_value(plane, o + d * t), 1e-13);
    const K::Quadric sphere{{0.7, 0.7, 0.7}, {}, {}, f.c};
    ASSERT_NEAR(K::along_value(K::sphere_along_ray(0.7, f.c, o, d), t),
                K::quadric_value(sphere, o + d * t), 1e-13);
    ASSERT_NEAR(K::along_value(K::small_sphere_along_ray(0.7, f.c, o, d), t),
                K::quadric_value(sphere, o + d * t), 1e-13);
  }
}

TEST(AlongRay, LessArithmeticGivesTheSameNumbers) {
  Numbers numbers(6);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 o = numbers.vec(), d = numbers.vec();
    const double t = numbers.any();
    const K::Quadric round{numbers.vec(), {}, {}, numbers.any()};
    const K::AlongRay f = K::quadric_along_ray(round, o, d),
                      same = K::diagonal_along_ray(round.diag, round.c, o, d);
    ASSERT_EQ(same.a, f.a);
    ASSERT_EQ(same.h, f.h);
    ASSERT_EQ(same.k, f.k);
    ASSERT_EQ(same.about, f.about);
    const K::AlongRay plane = K::plane_along_ray(numbers.vec(), o, d);
    ASSERT_EQ(K::plane_value(plane, t), K::along_value(plane, t));
  }
}

TEST(AlongRay, SmallBodiesFarFromTheRaysOriginKeepTheirDigits) {
  // A ball and a cylinder wall of radius 1, a million away: their squares cancel to a
  // ten-thousandth if the ray is not moved.
  const Vec3 d = normalize(Vec3{3, 4, 1});
  for (const double miss : {0.0, 0.5, 0.999}) {
    const Vec3 aside = Vec3{4, -3, 0} / 5.0 * miss;
    const Vec3 o = d * -1e6 + aside;
    const double ball = 1e6 - std::sqrt(1 - miss * miss);
    const K::Quadric sphere{{0.5, 0.5, 0.5}, {}, {}, -0.5};
    EXPECT_NEAR(K::along_root(K::small_quadric_along_ray(sphere, o, d), false), ball, 2e-8);
    EXPECT_NEAR(K::along_root(K::small_sphere_along_ray(0.5, -0.5, o, d), false), ball, 2e-8);
    const K::Quadric wall{{0.5, 0.5, 0}, {}, {}, -0.5};
    const double slope = std::hypot(d.x, d.y);
    EXPECT_NEAR(K::along_root(K::small_quadric_along_ray(wall, o, d), false),
                1e6 - std::sqrt(1 - miss * miss) / slope, 2e-8);
  }
}

TEST(AlongRay, FlatBodiesKeepTheirDigits) {
  // Semi-axes 1, 1 and 1e-6; through (0.6, 0, 0), where it is 1.6e-6 thick, aslant.
  const K::Quadric disc{{1, 1, 1e12}, {}, {}, -1};
  const Vec3 d = normalize(Vec3{1, -2, 1});
  const K::AlongRay f = K::small_quadric_along_ray(disc, Vec3{0.6, 0, 0} - d * 0.75, d);
  const double half = 0.8e-6 / d.z;
  // The way in, seen from its middle: a part in 1e8 of the thickness, a part in 1e14 of the disc.
  EXPECT_NEAR(K::along_root(f, false) - 0.75, -half, 1e-5 * half);
  EXPECT_NEAR(K::along_root(f, true) - 0.75, half, 1e-5 * half);
}

TEST(AlongRay, AlongTheAxisOfAWallNothingIsDivided) {
  const K::Quadric wall{{0.5, 0.5, 0}, {}, {}, -0.5};
  const K::AlongRay f = K::small_quadric_along_ray(wall, {0.25, 0, -7}, {0, 0, 1});
  EXPECT_EQ(f.a, 0);
  EXPECT_EQ(f.h, 0);
  EXPECT_EQ(K::along_value(f, 123), 0.5 * 0.0625 - 0.5);
  const K::AlongRay on_axis = K::small_quadric_along_ray(wall, {0, 0, -7}, {0, 0, 1});
  EXPECT_EQ(K::along_value(on_axis, 0), -0.5);
}

}  // namespace
}  // namespace whittle

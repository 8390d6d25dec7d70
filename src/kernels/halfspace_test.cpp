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

double sign_at(double a, double h, double k, double t) {
  return (a * t + 2 * h) * t + k;
}

TEST(QuadraticRoots, TellTheSignEverywhere) {
  Numbers numbers(1);
  int crossing = 0;
  for (int i = 0; i < 200000; ++i) {
    const double a = numbers.any(), h = numbers.any(), k = numbers.any();
    const K::Roots roots = K::quadratic_roots(a, h, k);
    if (roots.crosses) {
      ++crossing;
      ASSERT_LE(roots.near_t, roots.far_t) << a << ' ' << h << ' ' << k;
    }
    for (int j = 0; j < 4; ++j) {
      const double t = numbers.any();
      const bool between = roots.crosses && roots.near_t < t && t < roots.far_t;
      const bool inside = between != roots.outer;
      const double value = sign_at(a, h, k, t);
      // Rounding blurs the sign next to a root; elsewhere it is certain.
      const double blur = 1e-13 * (std::fabs(a * t * t) + std::fabs(2 * h * t) + std::fabs(k));
      const bool certain =
          std::fabs(value) > blur && std::fabs(h * h - a * k) > 1e-12 * (h * h + std::fabs(a * k));
      ASSERT_TRUE(!certain || inside == (value < 0)) << a << ' ' << h << ' ' << k << " at " << t;
    }
  }
  EXPECT_GT(crossing, 50000);
}

TEST(QuadraticRoots, KeepTheirDigitsWhenOneRootIsTiny) {
  // (t - 1e-9)(t - 1e9): the textbook formula loses the small root altogether.
  const K::Roots roots = K::quadratic_roots(1, -0.5 * (1e9 + 1e-9), 1);
  EXPECT_NEAR(roots.near_t, 1e-9, 1e-23);
  EXPECT_NEAR(roots.far_t, 1e9, 1e-5);
}

TEST(QuadraticRoots, LinearEquationsHaveOneFiniteRoot) {
  for (const double zero : {0.0, -0.0}) {
    const K::Roots rising = K::quadratic_roots(zero, 1, -4);  // 2t - 4: negative before 2
    EXPECT_TRUE(rising.crosses && !rising.outer);
    EXPECT_EQ(rising.near_t, -INFINITY);
    EXPECT_EQ(rising.far_t, 2);
    const K::Roots falling = K::quadratic_roots(zero, -1, 4);  // 4 - 2t: negative after 2
    EXPECT_TRUE(falling.crosses && !falling.outer);
    EXPECT_EQ(falling.near_t, 2);
    EXPECT_EQ(falling.far_t, INFINITY);
    EXPECT_TRUE(K::quadratic_roots(zero, 0, -1).outer);
    EXPECT_FALSE(K::quadratic_roots(zero, 0, 1).outer);
  }
}

TEST(Quadric, RangeHoldsEveryValueInTheBox) {
  Numbers numbers(2);
  for (int i = 0; i < 50000; ++i) {
    const K::Quadric f = numbers.quadric();
    const Vec3 m = numbers.vec(), h = abs(numbers.vec());
    const K::Vec2 range = K::quadric_range(f, m, h, 1e-14);
    for (int j = 0; j < 4; ++j) {
      // Weights in [-1, 1], corners preferred: the sample cannot leave the box by more than
      // rounding.
      const auto weight = [&] {
        return numbers.engine() % 2 ? numbers.uniform(-1, 1) : numbers.engine() % 2 ? 1.0 : -1.0;
      };
      const Vec3 p{m.x + h.x * weight(), m.y + h.y * weight(), m.z + h.z * weight()};
      const double value = K::quadric_value(f, p);
      ASSERT_LE(range.x, value);
      ASSERT_GE(range.y, value);
    }
  }
}

TEST(Quadric, RangeIsTightForSpheres) {
  const K::Quadric sphere{{1, 1, 1}, {}, {}, -1};
  const K::Vec2 range = K::quadric_range(sphere, {0.25, 0, 0}, {0.5, 0.5, 0.5}, 0);
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
    const Vec3 d{numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
    const double t = numbers.uniform(-2, 2);
    const Vec3 c = K::quadric_along_ray(f, o, d);
    ASSERT_NEAR(sign_at(c.x, c.y, c.z, t), K::quadric_value(f, o + d * t), 1e-10);
  }
}

}  // namespace
}  // namespace whittle

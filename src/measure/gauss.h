// Gauss's rules on [-1, 1], and how wrong they can be of a function that is analytic around it.
#pragma once

#include <array>
#include <cstddef>

namespace whittle {

struct GaussRule {
  static constexpr size_t kMost = 10;
  size_t size = 0;
  std::array<double, kMost> at{}, weight{};
};

/// The rule of n points, 1 <= n <= kMost.
GaussRule gauss_rule(size_t n);

/// Ellipses in the complex plane with foci -1 and 1, whose half axes have the sum rho. They lie in
/// the disc of radius (rho + 1 / rho) / 2.
inline constexpr std::array<double, 12> kEllipses = {1.25, 1.6, 2,  2.7, 3.7, 5,
                                                     7,    10,  15, 25,  45,  90};
constexpr double ellipse_reach(double rho) {
  return (rho + 1 / rho) / 2;
}

/// How wrong the rule of n points is, at most, as a multiple of the largest value of the function's
/// modulus in the ellipse. It is exact for polynomials of degree 2n - 1; one of them is nowhere
/// farther from the function than 2 rho^(1 - 2n) / (rho - 1) of that (Bernstein; Trefethen,
/// Approximation Theory and Approximation Practice, theorem 8.2), and both the integral and the
/// rule multiply that by two at most.
double gauss_error(size_t n, double rho);

/// All rules, and their errors for all ellipses.
class GaussTable {
 public:
  GaussTable();

  const GaussRule& rule(size_t n) const { return rules_[n]; }
  double error(size_t n, size_t ellipse) const { return errors_[n][ellipse]; }

 private:
  std::array<GaussRule, GaussRule::kMost + 1> rules_;
  std::array<std::array<double, kEllipses.size()>, GaussRule::kMost + 1> errors_{};
};

}  // namespace whittle

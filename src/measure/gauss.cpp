#include "measure/gauss.h"

#include <cmath>
#include <numbers>

namespace whittle {

GaussRule gauss_rule(size_t n) {
  GaussRule rule{n, {}, {}};
  for (size_t i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (double(i) + 0.75) / (double(n) + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      // Legendre's polynomials by their recurrence, and Newton's step to the root.
      double before = 1, value = x;
      for (size_t k = 2; k <= n; ++k) {
        const double next = (double(2 * k - 1) * x * value - double(k - 1) * before) / double(k);
        before = value, value = next;
      }
      slope = double(n) * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.at[i] = x;
    rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

double gauss_error(size_t n, double rho) {
  return 8 * std::pow(rho, 1 - 2 * double(n)) / (rho - 1);
}

GaussTable::GaussTable() {
  for (size_t n = 1; n <= GaussRule::kMost; ++n) {
    rules_[n] = gauss_rule(n);
    for (size_t e = 0; e < kEllipses.size(); ++e) errors_[n][e] = gauss_error(n, kEllipses[e]);
  }
}

}  // namespace whittle

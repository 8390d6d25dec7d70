#include "flat/orientation.h"

#include <array>
#include <cmath>
#include <limits>

namespace whittle {

namespace {

/// A number as a sum of doubles that do not overlap, the smallest first.
class Expansion {
 public:
  void add(double value) {
    size_t kept = 0;
    for (size_t i = 0; i < size_; ++i) {
      const double sum = value + part_[i];
      const double virtual_part = sum - value;
      const double lost = (value - (sum - virtual_part)) + (part_[i] - virtual_part);
      if (lost != 0) part_[kept++] = lost;
      value = sum;
    }
    if (value != 0) part_[kept++] = value;
    size_ = kept;
  }

  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  /// The largest part has the sign of the sum.
  double leading() const { return size_ == 0 ? 0 : part_[size_ - 1]; }

 private:
  std::array<double, 12> part_{};
  size_t size_ = 0;
};

double exact(Vec2 a, Vec2 b, Vec2 c) {
  Expansion sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.leading();
}

}  // namespace

double orientation(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
  constexpr double kBound = (3 + 16 * kEpsilon) * kEpsilon;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double difference = left - right;
  if (std::abs(difference) > kBound * (std::abs(left) + std::abs(right))) return difference;
  return exact(a, b, c);
}

}  // namespace whittle

#include "base/degrees.h"

#include <cmath>
#include <numbers>

namespace whittle {
namespace {

/// sin of 0..90 degrees.
double sin_first_quadrant(double x) {
  if (x == 0) return 0;
  if (x == 30) return 0.5;
  if (x == 45) return std::numbers::sqrt2 / 2;
  if (x == 60) return std::numbers::sqrt3 / 2;
  if (x == 90) return 1;
  constexpr double kRadians = std::numbers::pi / 180;
  // The smaller of the two complementary angles keeps more digits.
  return x <= 45 ? std::sin(x * kRadians) : std::cos((90 - x) * kRadians);
}

}  // namespace

double sin_degrees(double degrees) {
  bool negative = degrees < 0;
  double x = std::fmod(std::fabs(degrees), 360);
  if (x >= 180) x -= 180, negative = !negative;
  if (x > 90) x = 180 - x;
  const double s = sin_first_quadrant(x);
  return negative && s != 0 ? -s : s;
}

double cos_degrees(double degrees) {
  double x = std::fmod(std::fabs(degrees), 360);
  if (x > 180) x = 360 - x;
  const bool negative = x > 90;
  if (negative) x = 180 - x;
  const double c = sin_first_quadrant(90 - x);
  return negative && c != 0 ? -c : c;
}

}  // namespace whittle

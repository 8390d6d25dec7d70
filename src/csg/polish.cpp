#include "csg/polish.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/degrees.h"

namespace whittle {

namespace {

/// Half a unit of the sixth digit of an entry near 1, and a little for rounding.
constexpr double kPrinted = 5.1e-7;
/// Products of two columns of a rotation whose entries are off by that are off by no more than
/// this: 2 sqrt(3) times as much.
constexpr double kSkewness = 3.5 * kPrinted;

/// Could "%.6g" have printed this entry of a rotation?
bool has_six_digits(double x) {
  double digits = std::fabs(x) * 1e6;
  if (digits < 1e-6) return true;
  while (digits < 1e5) digits *= 10;
  return std::fabs(digits - std::round(digits)) < 1e-3;
}

bool has_six_digits(const Affine& a) {
  return std::ranges::all_of(a.row, [](const Vec3& r) {
    return has_six_digits(r.x) && has_six_digits(r.y) && has_six_digits(r.z);
  });
}

/// Could "%.6g" have printed `x` as `printed`?
bool prints_as(double x, double printed) {
  double digit = 1e-6;  // the sixth
  while (digit > 1e-15 && std::fabs(printed) < 1e5 * digit) digit /= 10;
  return std::fabs(x - printed) <= 0.51 * digit;
}

bool prints_as(const Affine& a, const Affine& printed) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!prints_as(a.row[i][j], printed.row[i][j])) return false;
  return true;
}

/// The largest entry of the linear part of a^T a - 1.
double skewness(const Affine& a) {
  double most = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      most = std::max(most, std::fabs(dot(a.row[i], a.row[j]) - (i == j)));
  return most;
}

double hundredths(double radians) {
  return std::round(radians * (18000 / std::numbers::pi)) / 100;
}

/// Rz(c) Ry(b) Rx(a), degrees.
Affine turn(double a, double b, double c) {
  const double ca = cos_degrees(a), sa = sin_degrees(a), cb = cos_degrees(b), sb = sin_degrees(b),
               cc = cos_degrees(c), sc = sin_degrees(c);
  return {.row = {{cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa},
                  {sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa},
                  {-sb, cb * sa, cb * ca}},
          .translation = {}};
}

/// The rotation by whole hundredths of degrees that prints as this one.
std::optional<Affine> by_angles(const Affine& r) {
  const double sb = std::clamp(-r.row[2].x, -1.0, 1.0);
  const double cb = std::hypot(r.row[2].y, r.row[2].z);
  // Looking straight up or down, x and z turn alike: all of it is given to z.
  const bool upright = cb < 1e-5;
  const double a = upright ? 0 : hundredths(std::atan2(r.row[2].y, r.row[2].z));
  const double b = hundredths(std::atan2(sb, cb));
  const double c = hundredths(upright ? std::atan2(-r.row[0].y, r.row[1].y)
                                      : std::atan2(r.row[1].x, r.row[0].x));
  const Affine turned = turn(a, b, c);
  if (!prints_as(turned, r)) return std::nullopt;
  return turned;
}

/// The nearest rotation: the orthogonal factor of the polar decomposition, by Newton's iteration
/// (Higham, Functions of Matrices, 8.3), which doubles the digits each time.
Affine nearest_rotation(Affine x) {
  for (int step = 0; step < 3; ++step) {
    const Affine y = inverse(x);
    const Affine transposed = {.row = {{y.row[0].x, y.row[1].x, y.row[2].x},
                                       {y.row[0].y, y.row[1].y, y.row[2].y},
                                       {y.row[0].z, y.row[1].z, y.row[2].z}},
                               .translation = {}};
    for (int i = 0; i < 3; ++i) x.row[i] = (x.row[i] + transposed.row[i]) * 0.5;
  }
  return x;
}

}  // namespace

Affine polished(const Affine& map) {
  if (!map.is_finite() || !(skewness(map) <= kSkewness) || !has_six_digits(map)) return map;
  const bool mirrored = map.determinant() < 0;
  const Affine mirror = scaling({mirrored ? -1.0 : 1.0, 1, 1});
  Affine rotation = map * mirror;
  rotation.translation = {};
  Affine result = by_angles(rotation).value_or(nearest_rotation(rotation)) * mirror;
  result.translation = map.translation;
  return result;
}

}  // namespace whittle

#include "measure/moments.h"

#include <cmath>

namespace whittle {

Moments moved(const Moments& m, Vec3 c) {
  Moments out = m;
  for (int i = 0; i < 3; ++i) {
    out[first_of(i)] += c[i] * m[kVolume];
    for (int j = i; j < 3; ++j) {
      out[product_of(i, j)] +=
          c[i] * m[first_of(j)] + c[j] * m[first_of(i)] + c[i] * c[j] * m[kVolume];
    }
  }
  return out;
}

Moments box_moments(Vec3 half) {
  Moments m{};
  m[kVolume] = 8 * half.x * half.y * half.z;
  for (int i = 0; i < 3; ++i) m[product_of(i, i)] = m[kVolume] * half[i] * half[i] / 3;
  return m;
}

Moments tetrahedron_moments(const std::array<Vec3, 4>& p) {
  Moments m{};
  m[kVolume] = std::fabs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]))) / 6;
  const Vec3 sum = p[0] + p[1] + p[2] + p[3];
  for (int i = 0; i < 3; ++i) {
    m[first_of(i)] = m[kVolume] * sum[i] / 4;
    for (int j = i; j < 3; ++j) {
      double products = sum[i] * sum[j];
      for (const Vec3& corner : p) products += corner[i] * corner[j];
      m[product_of(i, j)] = m[kVolume] * products / 20;
    }
  }
  return m;
}

Moments weighted(double volume, Vec3 center, Vec3 half) {
  Moments m{};
  const Vec3 reach = abs(center) + half;
  m[kVolume] = volume;
  for (int i = 0; i < 3; ++i) {
    m[first_of(i)] = volume * reach[i];
    for (int j = i; j < 3; ++j) m[product_of(i, j)] = volume * reach[i] * reach[j];
  }
  return m;
}

void CompensatedSum::add(double x) {
  const double sum = sum_ + x;
  rest_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
  sum_ = sum;
}

void CompensatedSum::add(const CompensatedSum& other) {
  add(other.sum_);
  rest_ += other.rest_;
}

void Integral::add(const Moments& moments) {
  for (size_t i = 0; i < kMomentCount; ++i) sums_[i].add(moments[i]);
}

void Integral::add(const Moments& moments, const Moments& bounds) {
  add(moments);
  add_bounds(bounds);
}

void Integral::add(const Integral& other) {
  for (size_t i = 0; i < kMomentCount; ++i) sums_[i].add(other.sums_[i]);
  add_bounds(other.bounds_);
}

void Integral::add_bounds(const Moments& bounds) {
  for (size_t i = 0; i < kMomentCount; ++i) bounds_[i] += bounds[i];
}

}  // namespace whittle

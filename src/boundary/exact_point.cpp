#include "boundary/exact_point.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace whittle {
namespace {

using Wide4 = WideInt<4>;

Int128 magnitude(Int128 value) {
  return value < 0 ? -value : value;
}

int sign(Int128 value) {
  return value < 0 ? -1 : value > 0 ? 1 : 0;
}

}  // namespace

int largest_axis(const ExactPlane& plane) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(plane.n[size_t(i)]) > std::abs(plane.n[size_t(axis)])) axis = i;
  return axis;
}

std::array<Int128, 3> direction(const ExactPlane& a, const ExactPlane& b) {
  std::array<Int128, 3> product;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    product[i] = Int128(a.n[j]) * b.n[k] - Int128(a.n[k]) * b.n[j];
  }
  return product;
}

HomogeneousPoint ExactGeometry::homogeneous(const std::array<uint32_t, 3>& planes) const {
  // Cramer's rule: y = (d_a (b x c) + d_b (c x a) + d_c (a x b)) / (a . (b x c)).
  const ExactPlane &a = plane(planes[0]), &b = plane(planes[1]), &c = plane(planes[2]);
  const std::array<Int128, 3> bc = direction(b, c), ca = direction(c, a), ab = direction(a, b);
  HomogeneousPoint result;
  for (size_t i = 0; i < 3; ++i) {
    result.w += product(bc[i], a.n[i]);
    result.x[i] = product(bc[i], a.d) + product(ca[i], b.d) + product(ab[i], c.d);
  }
  if (result.w.is_negative()) {
    result.w = -result.w;
    for (WideInt<3>& x : result.x) x = -x;
  }
  return result;
}

ExactPoint ExactGeometry::meet(uint32_t a, uint32_t b, uint32_t c) const {
  ExactPoint point;
  point.planes = {a, b, c};
  const HomogeneousPoint fractions = homogeneous(point.planes);
  const Wide4 divisor(fractions.w);
  point.is_whole = true;
  for (size_t i = 0; i < 3; ++i) {
    bool is_whole;
    point.floor[i] = floor_of_quotient(Wide4(fractions.x[i]).shifted(ExactPoint::kFractionBits),
                                       divisor, is_whole);
    point.is_whole = point.is_whole && is_whole;
  }
  return point;
}

ApproximatePoint ExactGeometry::about(uint32_t a, uint32_t b, uint32_t c) const {
  const RoundedPlane &p = rounded(a), &q = rounded(b), &r = rounded(c);
  const Vec3 qr = cross(q.n, r.n), rp = cross(r.n, p.n), pq = cross(p.n, q.n);
  const double w = dot(p.n, qr);
  ApproximatePoint point;
  point.planes = {a, b, c};
  point.y = (qr * p.d + rp * q.d + pq * r.d) / w;
  // Components of normals are exact and at most 1. So those of products are off by 2^-51, w by
  // 2^-48, and the sums of three products by 2^-49 of what the distances add up to.
  constexpr double kUnit = 0x1p-48;
  const double distances = std::fabs(p.d) + std::fabs(q.d) + std::fabs(r.d);
  const double most = max_component(abs(point.y));
  // What w is off is told from w itself only where that is much larger.
  const double size = std::fabs(w) - kUnit;
  point.error = size > kUnit ? kUnit * (distances + 2 * most) / size : kInfinity;
  return point;
}

PlaneSide ExactGeometry::exact_side(const std::array<uint32_t, 3>& point, uint32_t number) const {
  if (std::find(point.begin(), point.end(), number) != point.end()) return 0;
  const ExactPlane& p = plane(number);
  const HomogeneousPoint fractions = homogeneous(point);
  Wide4 exact = -(Wide4(p.d) * Wide4(fractions.w));
  for (size_t i = 0; i < 3; ++i) exact += Wide4(fractions.x[i]).times(p.n[i]);
  return PlaneSide(exact.sign());
}

PlaneSide ExactGeometry::side(const ExactPoint& point, uint32_t number) const {
  const ExactPlane& p = plane(number);
  // n.y - d, times 2^kFractionBits: what rounding has taken away adds between `low` and `high`.
  Int128 value = -(p.d << ExactPoint::kFractionBits), low = 0, high = 0;
  for (size_t i = 0; i < 3; ++i) {
    value += Int128(p.n[i]) * point.floor[i];
    (p.n[i] < 0 ? low : high) += p.n[i];
  }
  if (point.is_whole) return PlaneSide(sign(value));
  if (value + low > 0) return 1;
  if (value + high < 0) return -1;
  return exact_side(point.planes, number);
}

bool ExactGeometry::is_same(const ExactPoint& p, const ExactPoint& q) const {
  if (p.floor != q.floor || p.is_whole != q.is_whole) return false;
  if (p.is_whole) return true;
  return std::all_of(q.planes.begin(), q.planes.end(),
                     [&](uint32_t plane) { return side(p, plane) == 0; });
}

int ExactGeometry::compare(const ExactPoint& p, const ExactPoint& q, int axis) const {
  const auto i = size_t(axis);
  if (p.floor[i] != q.floor[i]) return p.floor[i] < q.floor[i] ? -1 : 1;
  if (p.is_whole && q.is_whole) return 0;
  const HomogeneousPoint a = homogeneous(p.planes), b = homogeneous(q.planes);
  using Wide6 = WideInt<6>;
  return (Wide6(a.x[i]) * Wide6(b.w) - Wide6(b.x[i]) * Wide6(a.w)).sign();
}

int ExactGeometry::turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int u,
                        int v) const {
  const auto i = size_t(u), j = size_t(v);
  const Int128 bu = Int128(b.floor[i]) - a.floor[i], bv = Int128(b.floor[j]) - a.floor[j],
               cu = Int128(c.floor[i]) - a.floor[i], cv = Int128(c.floor[j]) - a.floor[j];
  const Int128 area = bu * cv - bv * cu;
  if (a.is_whole && b.is_whole && c.is_whole) return sign(area);
  // Every difference is off by less than one.
  if (magnitude(area) > magnitude(bu) + magnitude(bv) + magnitude(cu) + magnitude(cv) + 2)
    return sign(area);
  using Wide9 = WideInt<9>;
  const HomogeneousPoint p = homogeneous(a.planes), q = homogeneous(b.planes),
                         r = homogeneous(c.planes);
  const auto minor = [&](const HomogeneousPoint& s, const HomogeneousPoint& t) {
    return Wide9(s.x[i]) * Wide9(t.x[j]) - Wide9(s.x[j]) * Wide9(t.x[i]);
  };
  return (minor(q, r) * Wide9(p.w) + minor(r, p) * Wide9(q.w) + minor(p, q) * Wide9(r.w)).sign();
}

}  // namespace whittle

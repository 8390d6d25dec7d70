#include "boundary/exact_point.h"

#include <algorithm>
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

HomogeneousPoint ExactGeometry::homogeneous(const ExactPoint& point) const {
  // Cramer's rule: y = (d_a (b x c) + d_b (c x a) + d_c (a x b)) / (a . (b x c)).
  const ExactPlane &a = plane(point.planes[0]), &b = plane(point.planes[1]),
                   &c = plane(point.planes[2]);
  const std::array<Int128, 3> bc = direction(b, c), ca = direction(c, a), ab = direction(a, b);
  const Wide4 da(a.d), db(b.d), dc(c.d);
  HomogeneousPoint result;
  for (size_t i = 0; i < 3; ++i) {
    result.w += Wide4(Int128(a.n[i])) * Wide4(bc[i]);
    result.x[i] = da * Wide4(bc[i]) + db * Wide4(ca[i]) + dc * Wide4(ab[i]);
  }
  if (result.w.is_negative()) {
    result.w = -result.w;
    for (Wide4& x : result.x) x = -x;
  }
  return result;
}

ExactPoint ExactGeometry::meet(uint32_t a, uint32_t b, uint32_t c) const {
  ExactPoint point;
  point.planes = {a, b, c};
  const HomogeneousPoint fractions = homogeneous(point);
  point.is_whole = true;
  for (size_t i = 0; i < 3; ++i) {
    const Wide4 scaled = fractions.x[i].shifted(ExactPoint::kFractionBits);
    point.floor[i] = floor_of_quotient(scaled, fractions.w);
    point.is_whole = point.is_whole && Wide4(point.floor[i]) * fractions.w == scaled;
  }
  return point;
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
  if (std::find(point.planes.begin(), point.planes.end(), number) != point.planes.end()) return 0;
  const HomogeneousPoint fractions = homogeneous(point);
  Wide4 exact = -(Wide4(p.d) * fractions.w);
  for (size_t i = 0; i < 3; ++i) exact += Wide4(Int128(p.n[i])) * fractions.x[i];
  return PlaneSide(exact.sign());
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
  const HomogeneousPoint a = homogeneous(p), b = homogeneous(q);
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
  const HomogeneousPoint p = homogeneous(a), q = homogeneous(b), r = homogeneous(c);
  const auto minor = [&](const HomogeneousPoint& s, const HomogeneousPoint& t) {
    return Wide9(s.x[i]) * Wide9(t.x[j]) - Wide9(s.x[j]) * Wide9(t.x[i]);
  };
  return (minor(q, r) * Wide9(p.w) + minor(r, p) * Wide9(q.w) + minor(p, q) * Wide9(r.w)).sign();
}

}  // namespace whittle

#include "measure/quadric_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/truth.h"

namespace whittle {
namespace {

using Tetrahedron = std::array<Vec3, 4>;

/// Cuts tetrahedra by planes until the table is constant in each. Depth: one call a plane.
class TetrahedronSum {
 public:
  explicit TetrahedronSum(std::span<const CellPlane> planes) : planes_(planes) {}

  void add(const Tetrahedron& t, uint64_t table, uint32_t next = 0) {
    if (table == 0) return;
    while (next < planes_.size() && !depends_on(table, next)) ++next;
    if (next >= planes_.size()) {
      const Moments moments = tetrahedron_moments(t);
      for (size_t i = 0; i < kMomentCount; ++i) sum_[i] += moments[i];
      return;
    }
    const uint64_t inside = cofactor(table, next, true), outside = cofactor(table, next, false);
    // Corners inside come first.
    Tetrahedron p;
    std::array<double, 4> value{};
    size_t in = 0, out = 4;
    for (const Vec3& corner : t) {
      const double v = planes_[next].at(corner);
      const size_t to = v <= 0 ? in++ : --out;
      p[to] = corner, value[to] = v;
    }
    const auto cut = [&](size_t a, size_t b) {
      return p[a] + (p[b] - p[a]) * (value[a] / (value[a] - value[b]));
    };
    ++next;
    if (in == 4) return add(t, inside, next);
    if (in == 0) return add(t, outside, next);
    if (in == 2) {
      const Vec3 ac = cut(0, 2), ad = cut(0, 3), bc = cut(1, 2), bd = cut(1, 3);
      add_wedge({p[0], ac, ad}, {p[1], bc, bd}, inside, next);
      add_wedge({p[2], ac, bc}, {p[3], ad, bd}, outside, next);
      return;
    }
    const size_t lone = in == 1 ? 0 : 3;
    const std::array<size_t, 3> rest =
        lone == 0 ? std::array<size_t, 3>{1, 2, 3} : std::array<size_t, 3>{0, 1, 2};
    std::array<Vec3, 3> cuts, others;
    for (size_t i = 0; i < 3; ++i) cuts[i] = cut(lone, rest[i]), others[i] = p[rest[i]];
    add({p[lone], cuts[0], cuts[1], cuts[2]}, lone == 0 ? inside : outside, next);
    add_wedge(cuts, others, lone == 0 ? outside : inside, next);
  }

  const Moments& sum() const { return sum_; }

 private:
  /// What lies between two triangles.
  void add_wedge(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, uint64_t table,
                 uint32_t next) {
    if (table == 0) return;
    add({a[0], a[1], a[2], b[0]}, table, next);
    add({a[1], a[2], b[0], b[1]}, table, next);
    add({a[2], b[0], b[1], b[2]}, table, next);
  }

  std::span<const CellPlane> planes_;
  Moments sum_{};
};

/// A convex polygon; in a box cut by six planes it has at most so many corners.
struct Polygon {
  static constexpr size_t kMost = 24;
  std::array<Vec3, kMost> corners;
  size_t size = 0;

  void add(Vec3 p) {
    if (size < kMost) corners[size++] = p;
  }
};

void cut_polygon(const Polygon& polygon, Vec3 n, double d, Polygon& inside, Polygon& outside) {
  for (size_t i = 0; i < polygon.size; ++i) {
    const Vec3 p = polygon.corners[i], q = polygon.corners[(i + 1) % polygon.size];
    const double a = dot(n, p) + d, b = dot(n, q) + d;
    (a <= 0 ? inside : outside).add(p);
    if ((a <= 0) == (b <= 0)) continue;
    const Vec3 cut = p + (q - p) * (a / (a - b));
    inside.add(cut);
    outside.add(cut);
  }
}

/// The part of a plane in a box.
Polygon section(const CellPlane& plane, Vec3 half) {
  const Vec3 size = abs(plane.n);
  const int k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (!(size[k] > 0)) return {};
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  Polygon polygon;
  for (const auto& [u, v] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vec3 p;
    p[i] = u * half[i], p[j] = v * half[j];
    p[k] = -(plane.d + plane.n[i] * p[i] + plane.n[j] * p[j]) / plane.n[k];
    polygon.add(p);
  }
  for (const double side : {-1.0, 1.0}) {
    Vec3 n;
    n[k] = side;
    Polygon inside, outside;
    cut_polygon(polygon, n, -half[k], inside, outside);
    polygon = inside;
  }
  return polygon;
}

double area_of(const Polygon& polygon) {
  Vec3 sum;
  for (size_t i = 2; i < polygon.size; ++i)
    sum +=
        cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
  return length(sum) / 2;
}

/// The area of a polygon where the solid is on one side of it only.
double boundary_area(std::span<const CellPlane> planes, const Polygon& polygon, uint64_t below,
                     uint64_t above, uint32_t next) {
  while (next < planes.size() && !depends_on(below, next) && !depends_on(above, next)) ++next;
  if (polygon.size < 3) return 0;
  if (next >= planes.size()) return below != above ? area_of(polygon) : 0;
  Polygon inside, outside;
  cut_polygon(polygon, planes[next].n, planes[next].d, inside, outside);
  const auto part = [&](const Polygon& p, bool is_inside) {
    return boundary_area(planes, p, cofactor(below, next, is_inside),
                         cofactor(above, next, is_inside), next + 1);
  };
  return part(inside, true) + part(outside, false);
}

/// The area, in a plane of normal `n`, of what is no farther than `reach` from another plane, both
/// normals unit; 0 if no point of the polygon is. All is in a box of that half size.
double strip(const Polygon& polygon, Vec3 n, Vec3 other, double d, double reach, Vec3 half) {
  if (!(reach > 0)) return 0;
  double least = kInfinity, most = -kInfinity;
  for (size_t i = 0; i < polygon.size; ++i) {
    const double value = dot(other, polygon.corners[i]) + d;
    least = std::min(least, value), most = std::max(most, value);
  }
  if (least > reach || most < -reach) return 0;
  const Vec3 along = cross(n, other);
  const double sine = length(along);
  double longest = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
    if (along[axis] != 0)
      longest = std::min(longest, 2 * half[axis] * sine / std::fabs(along[axis]));
  return sine > 0 ? 2 * reach / sine * longest : kInfinity;
}

/// How far the area of one half-space's surface can be from that of its plane. Seen along the
/// plane's normal, both have the same parts but where another plane or a side of the box is as near
/// as the surfaces may be from their planes; and the surface leans by `turn` at most.
double area_bound(const PlaneCell& cell, size_t i, const Polygon& polygon, double area,
                  uint64_t below, uint64_t above) {
  const CellPlane& plane = cell.planes[i];
  const double slope = length(plane.n);
  if (!(plane.turn < slope)) return kInfinity;
  const double off = plane.deviation / slope;
  const double sine = plane.turn / slope, cosine = std::sqrt(1 - sine * sine);
  const Vec3 half = cell.half + Vec3{off, off, off};
  const double most = std::max(area, area_of(section(plane, half)) / cosine - area);
  if (polygon.size < 3) return most;
  const Vec3 n = plane.n / slope;
  double strips = 0;
  for (uint32_t j = 0; j < cell.planes.size(); ++j) {
    if (j == i || (!depends_on(below, j) && !depends_on(above, j))) continue;
    const CellPlane& other = cell.planes[j];
    const double steep = length(other.n);
    if (!(steep > 0)) return kInfinity;
    strips +=
        strip(polygon, n, other.n / steep, other.d / steep, other.deviation / steep + off, half);
  }
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 side;
    side[axis] = 1;
    const double reach = off * std::fabs(n[axis]);
    for (const double d : {-cell.half[axis], cell.half[axis]})
      strips += strip(polygon, n, side, d, reach, half);
  }
  return std::min(most, strips / cosine + area * (1 / cosine - 1));
}

/// At most so much of one surface is in the box. Lines along an axis meet it once, if its slope
/// along the axis is nowhere 0.
double most_of(const CellPlane& plane, Vec3 half) {
  double most = most_area(half);
  const double steepest = length(plane.n) + plane.turn;
  for (int k = 0; k < 3; ++k) {
    const double least = std::fabs(plane.n[k]) - plane.turn;
    const double base = 4 * half[(k + 1) % 3] * half[(k + 2) % 3];
    if (least > 0) most = std::min(most, base * steepest / least);
  }
  return most;
}

}  // namespace

Quadric quadric_about(const HalfSpace& h, Vec3 center) {
  using K = Kernels<double>;
  const Vec3 m = center - h.center;
  return {h.f.diag, h.f.off, K::quadric_half_gradient(h.f, m), K::quadric_value(h.f, m)};
}

CellPlane cell_plane(const Quadric& f, Vec3 half) {
  CellPlane plane{f.b * 2, f.c, 0, 0};
  double low = 0, high = 0;
  Vec3 turn;
  for (int i = 0; i < 3; ++i) {
    const double square = f.diag[i] * half[i] * half[i];
    (square < 0 ? low : high) += square;
    for (int j = 0; j < 3; ++j) turn[i] += 2 * std::fabs(entry(f, i, j)) * half[j];
    const int j = (i + 1) % 3;
    const double product = 2 * std::fabs(entry(f, i, j)) * half[i] * half[j];
    low -= product, high += product;
  }
  plane.d += (low + high) / 2;
  plane.deviation = (high - low) / 2;
  plane.turn = length(turn);
  return plane;
}

double slab_volume(const CellPlane& plane, Vec3 half) {
  double volume = 8 * half.x * half.y * half.z;
  for (int k = 0; k < 3; ++k) {
    const double slope = std::fabs(plane.n[k]);
    const double base = 4 * half[(k + 1) % 3] * half[(k + 2) % 3];
    // Also right where the slope is 0, unless the deviation is, too.
    if (plane.deviation == 0 && slope > 0) return 0;
    if (slope > 0) volume = std::min(volume, base * plane.deviation / slope);
  }
  return volume;
}

int best_split(std::span<const Quadric> surfaces, Vec3 half) {
  int best = half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
  const auto cost = [&](int axis) {
    Vec3 part = half;
    part[axis] /= 2;
    double slabs = 0, halves = 2;
    for (const Quadric& f : surfaces) {
      const CellPlane plane = cell_plane(f, part);
      slabs += slab_volume(plane, part);
      // A surface that is square to the axis is in one of the halves only; and it takes all of them
      // to make an edge.
      const Vec3 steps = {std::fabs(plane.n.x) * half.x, std::fabs(plane.n.y) * half.y,
                          std::fabs(plane.n.z) * half.z};
      const double others = steps.x + steps.y + steps.z - steps[axis];
      if (others < steps[axis]) halves = std::min(halves, 1 + others / steps[axis]);
    }
    return slabs * halves;
  };
  double least = cost(best) * (1 - 1e-9);
  for (int axis = 0; axis < 3; ++axis)
    if (const double its = cost(axis); its < least) best = axis, least = its;
  return best;
}

Moments solid_moments(const PlaneCell& cell) {
  TetrahedronSum sum(cell.planes);
  // Six tetrahedra along the diagonal, one for each order in which the axes may be walked.
  for (int first = 0; first < 3; ++first) {
    for (int turn = 1; turn < 3; ++turn) {
      std::array<Vec3, 4> t;
      t[0] = -cell.half;
      t[1] = t[0];
      t[1][first] += 2 * cell.half[first];
      const int second = (first + turn) % 3;
      t[2] = t[1];
      t[2][second] += 2 * cell.half[second];
      t[3] = cell.half;
      sum.add(t, cell.table);
    }
  }
  return sum.sum();
}

AreaBounds surface_area(const PlaneCell& cell) {
  AreaBounds all;
  for (uint32_t i = 0; i < cell.planes.size(); ++i) {
    if (!depends_on(cell.table, i)) continue;
    const uint64_t below = cofactor(cell.table, i, true), above = cofactor(cell.table, i, false);
    const Polygon polygon = section(cell.planes[i], cell.half);
    const double area = boundary_area(cell.planes, polygon, below, above, 0);
    all.area += area;
    const double most = std::max(area, most_of(cell.planes[i], cell.half) - area);
    all.bound += std::min(most, area_bound(cell, i, polygon, area, below, above));
  }
  return all;
}

double most_area(Vec3 h) {
  return 8 * (h.x * h.y + h.y * h.z + h.z * h.x);
}

}  // namespace whittle

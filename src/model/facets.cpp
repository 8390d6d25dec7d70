#include "model/facets.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/box.h"
#include "base/result.h"
#include "model/corner_tree.h"

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

/// The corners of OpenSCAD's circle of radius 1 and n fragments, the first on +x.
std::vector<Vec3> unit_circle(int n) {
  std::vector<Vec3> points;
  points.reserve(size_t(n));
  for (int k = 0; k < n; ++k)
    points.push_back({cos_degrees(360.0 * k / n), sin_degrees(360.0 * k / n), 0});
  return points;
}

/// The directions of the middles of that circle's sides.
std::vector<Vec3> side_middles(int n) {
  std::vector<Vec3> directions;
  directions.reserve(size_t(n));
  for (int k = 0; k < n; ++k) {
    const double degrees = 180.0 * (2.0 * k + 1) / n;
    directions.push_back({cos_degrees(degrees), sin_degrees(degrees), 0});
  }
  return directions;
}

/// Rings of OpenSCAD's sphere of n meridians; there is none at the poles.
int ring_count(int n) {
  return n / 2 + n % 2;
}

struct Planes {
  std::vector<Plane> operator()(const Cube& s) const {
    const Vec3 lo = s.center ? s.size * -0.5 : Vec3{};
    const Vec3 hi = s.center ? s.size * 0.5 : s.size;
    return {{{-1, 0, 0}, -lo.x}, {{1, 0, 0}, hi.x},   {{0, -1, 0}, -lo.y},
            {{0, 1, 0}, hi.y},   {{0, 0, -1}, -lo.z}, {{0, 0, 1}, hi.z}};
  }

  std::vector<Plane> operator()(const Sphere& s) const {
    const int n = s.facets, rings = ring_count(n);
    const double apothem = cos_degrees(180.0 / n), half_step = cos_degrees(90.0 / rings);
    const std::vector<Vec3> middles = side_middles(n);
    std::vector<Plane> planes;
    planes.reserve(size_t(n) * size_t(rings - 1) + 2);
    planes.push_back({{0, 0, 1}, s.r * half_step});
    planes.push_back({{0, 0, -1}, s.r * half_step});
    for (int i = 1; i < rings; ++i) {
      // The chord between two rings is normal to the bisector of their polar angles; the middle of
      // a facet stands closer to the axis by the apothem. So written, the planes above and below
      // the equator mirror one another exactly.
      const double polar = 180.0 * i / rings;
      const Vec3 meridian = {sin_degrees(polar), 0, apothem * cos_degrees(polar)};
      const double scale = 1 / length(meridian);
      for (const Vec3 p : middles)
        planes.push_back({Vec3{meridian.x * p.x, meridian.x * p.y, meridian.z} * scale,
                          s.r * apothem * half_step * scale});
    }
    return planes;
  }

  std::vector<Plane> operator()(const Cylinder& s) const {
    const int n = s.facets;
    const double z0 = s.center ? -s.h / 2 : 0, z1 = s.center ? s.h / 2 : s.h;
    std::vector<Plane> planes;
    planes.reserve(size_t(n) + 2);
    if (s.r1 > 0) planes.push_back({{0, 0, -1}, -z0});
    if (s.r2 > 0) planes.push_back({{0, 0, 1}, z1});
    const double apothem = cos_degrees(180.0 / n), rise = (s.r1 - s.r2) * apothem;
    const double size = std::hypot(s.h, rise);
    const double across = s.h / size, up = rise / size;
    // Taken at the wider end, where cancellation is least.
    const double d =
        s.r1 >= s.r2 ? across * s.r1 * apothem + up * z0 : across * s.r2 * apothem + up * z1;
    for (const Vec3 p : side_middles(n)) planes.push_back({{across * p.x, across * p.y, up}, d});
    return planes;
  }

  std::vector<Plane> operator()(const Polyhedron& s) const { return s.planes; }
  std::vector<Plane> operator()(const Mesh& s) const { return s.surface->facets; }

  std::vector<Plane> operator()(const Halfspace& s) const {
    // Divided by the largest component first, so that no square overflows or vanishes.
    const double m = max_component(abs(s.n));
    const double l = length(s.n / m);
    return {{s.n / m / l, s.d / m / l}};
  }
};

struct Vertices {
  std::vector<Vec3> operator()(const Cube& s) const {
    const Box box = s.center ? Box{s.size * -0.5, s.size * 0.5} : Box{{}, s.size};
    std::vector<Vec3> points;
    points.reserve(8);
    for (int i = 0; i < 8; ++i) points.push_back(box.corner(i));
    return points;
  }

  std::vector<Vec3> operator()(const Sphere& s) const {
    const int n = s.facets, rings = ring_count(n);
    const std::vector<Vec3> circle = unit_circle(n);
    std::vector<Vec3> points;
    points.reserve(size_t(n) * size_t(rings));
    for (int i = 0; i < rings; ++i) {
      const double polar = 180.0 * (i + 0.5) / rings;
      const double r = s.r * sin_degrees(polar), z = s.r * cos_degrees(polar);
      for (const Vec3 p : circle) points.push_back({p.x * r, p.y * r, z});
    }
    return points;
  }

  std::vector<Vec3> operator()(const Cylinder& s) const {
    const double z0 = s.center ? -s.h / 2 : 0, z1 = s.center ? s.h / 2 : s.h;
    std::vector<Vec3> points;
    for (const auto& [r, z] : {std::pair{s.r1, z0}, std::pair{s.r2, z1}}) {
      if (r == 0) points.push_back({0, 0, z});
      for (const Vec3 p : unit_circle(r > 0 ? s.facets : 0))
        points.push_back({p.x * r, p.y * r, z});
    }
    return points;
  }

  std::vector<Vec3> operator()(const Polyhedron& s) const {
    std::vector<bool> used(s.points.size());
    std::vector<Vec3> points;
    for (const auto& face : s.faces) {
      if (face.size() < 3) continue;
      for (const uint32_t i : face)
        if (!used[i]) used[i] = true, points.push_back(s.points[i]);
    }
    return points;
  }

  std::vector<Vec3> operator()(const Mesh& s) const { return s.surface->points; }
  std::vector<Vec3> operator()(const Halfspace&) const { return {}; }
};

/// Calls `visit(corner)` for all corners less than `slack` below a plane that is above them all.
template <class Visit>
void all_near(const CornerTree& tree, const Plane& plane, double slack, Vec3 middle,
              const Visit& visit) {
  tree.search(
      plane.n, middle, [&](double most_height, double) { return plane.d - most_height <= slack; },
      [&](const CornerTree::Corner& corner) {
        if (plane.d - dot(plane.n, corner.place) <= slack) visit(corner);
      });
}

/// The boxes of a polyhedron whose planes stand off its corners. A point of a facet is then no
/// farther than `slack` from some face, if no edge is much sharper than a right angle, and so from
/// what of that face is less than `slack` below the plane; all that goes into the box.
std::vector<Box> loose_facet_boxes(const Polyhedron& p, const Affine& map, double slack) {
  std::vector<std::vector<uint32_t>> neighbours(p.points.size());
  for (const auto& face : p.faces) {
    if (face.size() < 3) continue;
    for (size_t k = 0; k < face.size(); ++k) {
      const uint32_t a = face[k], b = face[(k + 1) % face.size()];
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  Box whole;
  for (size_t i = 0; i < p.points.size(); ++i)
    if (!neighbours[i].empty()) whole.include(p.points[i]);
  std::vector<CornerTree::Corner> corners;
  for (uint32_t i = 0; i < p.points.size(); ++i)
    if (!neighbours[i].empty()) corners.push_back({p.points[i], p.points[i] - whole.center(), i});
  const CornerTree tree(std::move(corners));
  const Vec3 margin = Vec3{length(map.row[0]), length(map.row[1]), length(map.row[2])} * slack;
  std::vector<Box> boxes;
  boxes.reserve(p.planes.size());
  for (const Plane& plane : p.planes) {
    Box& box = boxes.emplace_back();
    all_near(tree, plane, slack, whole.center(), [&](const CornerTree::Corner& corner) {
      box.include(map.point(corner.place));
      const double above = plane.d - dot(plane.n, corner.place);
      for (const uint32_t next : neighbours[corner.number]) {
        const double below = plane.d - dot(plane.n, p.points[next]);
        if (below <= slack) continue;
        const double t = (slack - above) / (below - above);
        box.include(map.point(corner.place + (p.points[next] - corner.place) * t));
      }
    });
    box.lo -= margin;
    box.hi += margin;
  }
  return boxes;
}

}  // namespace

int fragments(double r, FragmentSettings settings) {
  // 2^-20: OpenSCAD's smallest length.
  if (r < 0x1p-20 || !std::isfinite(settings.fn)) return 3;
  const double fa = std::fmax(settings.fa, 0.01), fs = std::fmax(settings.fs, 0.01);
  const double n =
      std::ceil(settings.fn > 0 ? std::fmax(settings.fn, 3)
                                : std::fmax(std::fmin(360 / fa, 2 * std::numbers::pi * r / fs), 5));
  constexpr int kMost = std::numeric_limits<int>::max();
  return n < kMost ? int(n) : kMost;
}

int choose_facets(double r, FragmentSettings settings, Curves curves) {
  if (curves == Curves::kSmooth) return 0;
  // A $fn that is not a number counts as given: OpenSCAD makes triangles of it.
  const bool is_curve = settings.fn <= 0;
  if (curves == Curves::kAuto && is_curve) return 0;
  if (curves == Curves::kOpenscad2021 && !is_curve) {
    settings.fn = std::floor(std::fmax(settings.fn, 3));
  }
  const int n = fragments(r, settings);
  return n > kMaxFacets ? 0 : n;
}

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

std::vector<Plane> facet_planes(const Shape& shape) {
  WHITTLE_CHECK(is_flat(shape) && !is_empty(shape));
  return std::visit(Planes{}, shape);
}

std::vector<Vec3> facet_vertices(const Shape& shape) {
  WHITTLE_CHECK(is_flat(shape) && !is_empty(shape));
  return std::visit(Vertices{}, shape);
}

std::vector<Box> facet_boxes(const Shape& shape, const Affine& map) {
  const std::vector<Plane> planes = facet_planes(shape);
  std::vector<Vec3> vertices = facet_vertices(shape);
  Box whole;
  for (const Vec3 p : vertices) whole.include(p);
  std::vector<Box> boxes(planes.size());
  const auto add = [&](size_t facet, size_t vertex) {
    boxes[facet].include(map.point(vertices[vertex]));
  };
  if (const auto* s = std::get_if<Sphere>(&shape)) {
    // Two caps, then rows of n trapezoids; vertices stand in rings of n, from the top.
    const size_t n = size_t(s->facets), rings = vertices.size() / n;
    for (size_t k = 0; k < n; ++k) {
      add(0, k);
      add(1, (rings - 1) * n + k);
      for (size_t i = 1; i < rings; ++i)
        for (const size_t corner : {k, (k + 1) % n}) {
          add(2 + (i - 1) * n + k, (i - 1) * n + corner);
          add(2 + (i - 1) * n + k, i * n + corner);
        }
    }
    return boxes;
  }
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    // A cap for each ring, then the sides; of a tip there is one vertex and no cap.
    const size_t n = size_t(c->facets), below = c->r1 > 0 ? n : 1, above = c->r2 > 0 ? n : 1;
    const size_t caps = planes.size() - n;
    for (size_t k = 0; k < n; ++k) {
      if (below == n) add(0, k);
      if (above == n) add(caps - 1, below + k);
      for (const size_t corner : {k, (k + 1) % n}) {
        add(caps + k, corner % below);
        add(caps + k, below + corner % above);
      }
    }
    return boxes;
  }
  // A facet's corners are the vertices on its plane, to the precision of text.
  const double slack = 2e-5 * whole.diagonal();
  if (const auto* s = std::get_if<Polyhedron>(&shape); s && 4 * s->rise > slack)
    return loose_facet_boxes(*s, map, 4 * s->rise);
  std::vector<CornerTree::Corner> corners;
  corners.reserve(vertices.size());
  for (size_t v = 0; v < vertices.size(); ++v)
    corners.push_back({vertices[v], vertices[v] - whole.center(), uint32_t(v)});
  const CornerTree tree(std::move(corners));
  for (size_t f = 0; f < planes.size(); ++f) {
    all_near(tree, planes[f], slack, whole.center(),
             [&](const CornerTree::Corner& corner) { add(f, corner.number); });
  }
  return boxes;
}

bool is_flat(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return s->facets >= 3;
  if (const auto* s = std::get_if<Cylinder>(&shape)) return s->facets >= 3;
  return true;
}

}  // namespace whittle

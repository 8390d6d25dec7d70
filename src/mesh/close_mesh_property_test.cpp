// Solids whose volume is known, as a careless program would write them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>

#include "base/box.h"
#include "mesh/close_mesh.h"

namespace whittle {
namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

int below(Random& random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(random);
}

/// A grid of quads that closes in both directions (a torus), or in one with a point at either end
/// (a ball), with points that stray.
RawMesh ring_mesh(Random& random, bool is_torus, Vec3 at, double size) {
  const int n = 3 + below(random, 14), m = 3 + below(random, 14);
  const double stray = between(random, 0, 0.1) * size;
  RawMesh raw;
  const auto add = [&](Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] += between(random, -1, 1) * stray / (n + m);
    raw.points.push_back(at + p);
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = kTurn * i / n;
      const double v = is_torus ? kTurn * j / m : kTurn / 2 * (j + 1) / (m + 1) - kTurn / 4;
      const double r = is_torus ? size * (0.7 + 0.3 * std::cos(v)) : size * std::cos(v);
      add({r * std::cos(u), r * std::sin(u), (is_torus ? 0.3 : 1) * size * std::sin(v)});
    }
  const auto corner = [&](int i, int j) { return uint32_t(j % m * n + i % n); };
  for (int j = 0; j + (is_torus ? 0 : 1) < m; ++j)
    for (int i = 0; i < n; ++i) {
      const uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                     d = corner(i, j + 1);
      if (below(random, 3) == 0) {
        raw.faces.push_back({a, b, c, d});
      } else {
        raw.faces.push_back({a, b, c});
        raw.faces.push_back({a, c, d});
      }
    }
  if (is_torus) return raw;
  add({0, 0, -size}), add({0, 0, size});
  for (int i = 0; i < n; ++i) {
    raw.faces.push_back({corner(i + 1, 0), corner(i, 0), uint32_t(n * m)});
    raw.faces.push_back({corner(i, m - 1), corner(i + 1, m - 1), uint32_t(n * m + 1)});
  }
  return raw;
}

/// Each side of a cube in its own pieces: with what divides a side's neighbours, but not it, there
/// are corners on edges.
RawMesh patched_cube(Random& random, Vec3 at, double size) {
  RawMesh raw;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const int n = 1 + below(random, 4), m = 1 + below(random, 4);
      const auto first = uint32_t(raw.points.size());
      for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) {
          Vec3 p;
          p[axis] = side * size, p[(axis + 1) % 3] = size * i / n, p[(axis + 2) % 3] = size * j / m;
          raw.points.push_back(p + at);
        }
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
          const auto k = first + uint32_t(j * (n + 1) + i), up = uint32_t(n + 1);
          if (side == 1)
            raw.faces.insert(raw.faces.end(), {{k, k + 1, k + up + 1}, {k, k + up + 1, k + up}});
          else
            raw.faces.insert(raw.faces.end(), {{k, k + up + 1, k + 1}, {k, k + up, k + up + 1}});
        }
    }
  return raw;
}

double volume_of(const RawMesh& raw) {
  double sum = 0;
  for (const auto& face : raw.faces)
    for (size_t k = 2; k < face.size(); ++k)
      sum += dot(raw.points[face[0]] - raw.points[0], cross(raw.points[face[k - 1]] - raw.points[0],
                                                            raw.points[face[k]] - raw.points[0])) /
             6;
  return sum;
}

double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.points[t.corners[0]] - mesh.points[0],
               cross(mesh.points[t.corners[1]] - mesh.points[0],
                     mesh.points[t.corners[2]] - mesh.points[0])) /
           6;
  return sum;
}

void append(RawMesh& to, const RawMesh& more, bool inside_out = false) {
  const auto shift = uint32_t(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  for (std::vector<uint32_t> face : more.faces) {
    for (uint32_t& corner : face) corner += shift;
    if (inside_out) std::reverse(face.begin(), face.end());
    to.faces.push_back(face);
  }
}

/// Every face with points of its own, in another order, starting anywhere, some of them turned, in
/// so many digits.
RawMesh carelessly_written(Random& random, const RawMesh& raw, int digits, double turned) {
  RawMesh written;
  std::vector<std::vector<uint32_t>> faces = raw.faces;
  std::ranges::shuffle(faces, random);
  for (std::vector<uint32_t>& face : faces) {
    std::rotate(face.begin(), face.begin() + below(random, int(face.size())), face.end());
    if (between(random, 0, 1) < turned) std::reverse(face.begin(), face.end());
    for (uint32_t& corner : face) {
      Vec3 p = raw.points[corner];
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = std::strtod(fmt::format("{:.{}g}", p[axis], digits).c_str(), nullptr);
      corner = uint32_t(written.points.size());
      written.points.push_back(p);
    }
    written.faces.push_back(face);
  }
  return written;
}

void expect_sound(const ClosedMesh& closed) {
  const TriangleMesh& mesh = closed.mesh;
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (size_t e = 0; e < 3; ++e) {
      const uint32_t a = t.corners[e], b = t.corners[(e + 1) % 3];
      ASSERT_NE(a, b);
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  for (const auto& [edge, balance] : edges) ASSERT_EQ(balance, 0);
  for (const Plane& plane : mesh.facets) ASSERT_NEAR(length(plane.n), 1, 1e-9);
  Box box;
  for (const Vec3& p : mesh.points) box.include(p);
  for (const auto& t : mesh.triangles)
    for (const uint32_t corner : t.corners) {
      const Plane& plane = mesh.facets[t.facet];
      ASSERT_LE(std::fabs(dot(plane.n, mesh.points[corner]) - plane.d),
                mesh.rise + 1e-12 * (box.diagonal() + std::fabs(plane.d)));
    }
}

Vec3 somewhere(Random& random) {
  // Far from the origin digits are few.
  const double far = std::pow(10, between(random, -1, 1.5));
  return {between(random, -far, far), between(random, -far, far), between(random, -far, far)};
}

TEST(CloseMeshProperty, BallsAndRings) {
  for (uint32_t seed = 0; seed < 600; ++seed) {
    Random random(seed);
    const RawMesh raw = ring_mesh(random, seed % 2 == 0, somewhere(random), 1);
    const ClosedMesh closed =
        close_mesh(carelessly_written(random, raw, 6, between(random, 0, 0.45)), 6);
    ASSERT_NO_FATAL_FAILURE(expect_sound(closed)) << seed;
    ASSERT_EQ(closed.open_edges, 0u) << seed;
    // The quads are not flat; which way one is cut is worth a little.
    const bool has_quads = std::ranges::any_of(raw.faces, [](auto& f) { return f.size() > 3; });
    ASSERT_NEAR(volume_of(closed.mesh), volume_of(raw), has_quads ? 0.08 : 1e-2) << seed;
  }
}

TEST(CloseMeshProperty, CracksAreMended) {
  for (uint32_t seed = 0; seed < 600; ++seed) {
    Random random(seed);
    const double size = between(random, 0.5, 3);
    const RawMesh raw = patched_cube(random, somewhere(random), size);
    const ClosedMesh closed =
        close_mesh(carelessly_written(random, raw, 6, seed % 2 == 0 ? 0 : 0.3), 6);
    ASSERT_NO_FATAL_FAILURE(expect_sound(closed)) << seed;
    ASSERT_EQ(closed.open_edges, 0u) << seed;
    ASSERT_NEAR(volume_of(closed.mesh), size * size * size, 2e-2) << seed;
  }
}

TEST(CloseMeshProperty, ShellsInShells) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    RawMesh raw;
    double expected = 0;
    const int beside = 1 + below(random, 3);
    for (int i = 0; i < beside; ++i) {
      const Vec3 at{4.0 * i, 0, 0};
      double size = 1;
      bool is_cavity = false;
      for (int depth = below(random, 4); depth >= 0; --depth) {
        const RawMesh shell = patched_cube(random, at - Vec3{size, size, size} * 0.5, size);
        append(raw, shell, is_cavity);
        expected += (is_cavity ? -1 : 1) * size * size * size;
        size *= 0.5;
        is_cavity = !is_cavity;
      }
    }
    // All of it inside out, or as it is.
    if (seed % 2 == 1)
      for (auto& face : raw.faces) std::reverse(face.begin(), face.end());
    const ClosedMesh closed = close_mesh(carelessly_written(random, raw, 6, 0), 6);
    ASSERT_NO_FATAL_FAILURE(expect_sound(closed)) << seed;
    ASSERT_EQ(closed.open_edges, 0u) << seed;
    ASSERT_NEAR(volume_of(closed.mesh), expected, 1e-3) << seed;
  }
}

TEST(CloseMeshProperty, CubesThatTouchInAGrid) {
  // Some of the cells of a grid, each with its six sides: they share sides, edges and corners.
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    RawMesh raw;
    int count = 0;
    for (int cell = 0; cell < 27; ++cell) {
      if (below(random, 2) == 0) continue;
      const Vec3 at{double(cell % 3), double(cell / 3 % 3), double(cell / 9)};
      RawMesh cube;
      for (int k = 0; k < 8; ++k)
        cube.points.push_back(at + Vec3{double(k & 1), double(k >> 1 & 1), double(k >> 2)});
      cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
      append(raw, cube);
      ++count;
    }
    const ClosedMesh closed = close_mesh(carelessly_written(random, raw, 6, 0), 6);
    ASSERT_NO_FATAL_FAILURE(expect_sound(closed)) << seed;
    ASSERT_EQ(closed.open_edges, 0u) << seed;
    ASSERT_NEAR(volume_of(closed.mesh), count, 1e-9) << seed;
  }
}

TEST(CloseMeshProperty, AnythingComesOutClosed) {
  // A soup with few points, so that faces share much; numbers of all kinds.
  constexpr double kOdd[] = {0, 1, -1, 1e-300, 1e75, 1e300, -1e308, 1e-5, 0.5};
  for (uint32_t seed = 0; seed < 4000; ++seed) {
    Random random(seed);
    RawMesh raw;
    const int points = 3 + below(random, 8), faces = 1 + below(random, 30);
    const bool is_odd = seed % 4 == 0;
    for (int i = 0; i < points; ++i) {
      Vec3 p{double(below(random, 4)), double(below(random, 4)), double(below(random, 4))};
      if (is_odd) p[below(random, 3)] = kOdd[below(random, 9)];
      if (is_odd && below(random, 9) == 0) p[below(random, 3)] = below(random, 2) ? NAN : INFINITY;
      raw.points.push_back(p);
    }
    for (int i = 0; i < faces; ++i) {
      std::vector<uint32_t> face;
      for (int k = 3 + below(random, 4) * below(random, 2); k > 0; --k)
        face.push_back(uint32_t(below(random, points)));
      raw.faces.push_back(face);
    }
    if (seed % 3 == 0) raw.triangles.assign(2, {0, 1, 2});
    const ClosedMesh closed = close_mesh(raw, seed % 5 == 0 ? 0 : 6);
    ASSERT_NO_FATAL_FAILURE(expect_sound(closed)) << seed;
  }
}

}  // namespace
}  // namespace whittle

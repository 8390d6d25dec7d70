#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

#include "support/read_text.h"

namespace whittle {
namespace {

/// Gives triangles their planes, one for all that lie in it but for rounding.
TriangleMesh with_facets(std::vector<Vec3> points, std::vector<std::array<uint32_t, 3>> corners) {
  TriangleMesh mesh;
  mesh.points = std::move(points);
  std::map<std::tuple<int64_t, int64_t, int64_t, int64_t>, uint32_t> known;
  for (const auto& t : corners) {
    const Vec3 a = mesh.points[t[0]];
    const Vec3 n = normalize(cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a));
    const double d = dot(n, a);
    const auto key = [](double x) { return std::llround(x * 1e9); };
    const auto [at, is_new] =
        known.try_emplace({key(n.x), key(n.y), key(n.z), key(d)}, uint32_t(mesh.facets.size()));
    if (is_new) mesh.facets.push_back({n, d});
    mesh.triangles.push_back({t, at->second});
  }
  return mesh;
}

}  // namespace

TriangleMesh box_mesh(const Box& box, int n) {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::map<std::tuple<int, int, int>, uint32_t> known;
  const auto point = [&](std::array<int, 3> at) {
    const auto [it, is_new] = known.try_emplace({at[0], at[1], at[2]}, uint32_t(points.size()));
    if (is_new) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const int k = at[size_t(axis)];
        p[axis] = k == n ? box.hi[axis] : box.lo[axis] + box.size()[axis] * k / n;
      }
      points.push_back(p);
    }
    return it->second;
  };
  for (size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
            return point(p);
          };
          const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side == n)
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
          else
            triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
        }
  return with_facets(points, triangles);
}

TriangleMesh star_mesh(int count, double inner, double outer, double h) {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  const auto n = uint32_t(2 * count);
  for (const double z : {0.0, h})
    for (uint32_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, r = k % 2 ? inner : outer;
      points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  points.push_back({0, 0, 0});
  points.push_back({0, 0, h});
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t next = (k + 1) % n;
    triangles.push_back({2 * n, next, k});
    triangles.push_back({2 * n + 1, n + k, n + next});
    triangles.push_back({k, next, n + next});
    triangles.push_back({k, n + next, n + k});
  }
  return with_facets(points, triangles);
}

TriangleMesh torus_mesh(double major, double minor, int n, int m) {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      const double r = major + minor * std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v) + 0.01 * (i % 3)});
    }
  const auto at = [&](int i, int j) { return uint32_t(i % n * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return with_facets(points, triangles);
}

TriangleMesh bumpy_mesh(double r, double bump, int n, uint32_t seed) {
  TriangleMesh ball = box_mesh({{-1, -1, -1}, {1, 1, 1}}, n);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> stray(1 - bump, 1 + bump);
  for (Vec3& p : ball.points) p = normalize(p) * (r * stray(random));
  std::vector<std::array<uint32_t, 3>> triangles;
  for (const TriangleMesh::Triangle& t : ball.triangles) triangles.push_back(t.corners);
  return with_facets(std::move(ball.points), std::move(triangles));
}

TriangleMesh changed(const TriangleMesh& mesh, double (*coordinate)(double)) {
  std::vector<Vec3> points = mesh.points;
  for (Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(p[axis]);
  std::vector<std::array<uint32_t, 3>> triangles;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3 a = points[t.corners[0]];
    if (cross(points[t.corners[1]] - a, points[t.corners[2]] - a) == Vec3{}) continue;
    triangles.push_back(t.corners);
  }
  return with_facets(std::move(points), std::move(triangles));
}

TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto points = uint32_t(all.points.size()), facets = uint32_t(all.facets.size());
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    all.facets.insert(all.facets.end(), mesh.facets.begin(), mesh.facets.end());
    for (TriangleMesh::Triangle t : mesh.triangles) {
      for (uint32_t& corner : t.corners) corner += points;
      t.facet += facets;
      all.triangles.push_back(t);
    }
  }
  return all;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (TriangleMesh::Triangle& t : mesh.triangles) std::swap(t.corners[1], t.corners[2]);
  for (Plane& plane : mesh.facets) plane = {-plane.n, -plane.d};
  return mesh;
}

Model with_meshes(const char* text, const std::vector<TriangleMesh>& meshes) {
  Model model = model_of(text, "meshes");
  for (Primitive& primitive : model.primitives) {
    const auto* const cube = std::get_if<Cube>(&primitive.shape);
    if (cube == nullptr) continue;
    const auto number = size_t(cube->size.x);
    if (number >= 1 && number <= meshes.size() && double(number) == cube->size.x)
      primitive.shape = Mesh{std::make_shared<const TriangleMesh>(meshes[number - 1])};
  }
  return model;
}

}  // namespace whittle

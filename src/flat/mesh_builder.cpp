#include "flat/mesh_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace whittle {

namespace {

/// 0 for both zeros.
uint64_t bits(double value) {
  return value == 0 ? 0 : std::bit_cast<uint64_t>(value);
}

uint64_t mixed(uint64_t seed, double value) {
  seed = (seed ^ bits(value)) * 0x9e3779b97f4a7c15u;
  return seed ^ (seed >> 29);
}

/// The direction across a and b, also where their product would leave the range of doubles.
Vec3 unit_across(Vec3 a, Vec3 b) {
  const double size_a = max_component(abs(a)), size_b = max_component(abs(b));
  if (size_a == 0 || size_b == 0) return {};
  const Vec3 across = cross(a / size_a, b / size_b);
  const double size = max_component(abs(across));
  return size > 0 ? normalize(across / size) : Vec3{};
}

}  // namespace

size_t MeshBuilder::Hash::operator()(const Vec3& p) const {
  return size_t(mixed(mixed(mixed(0, p.x), p.y), p.z));
}

size_t MeshBuilder::Hash::operator()(const Plane& plane) const {
  return size_t(mixed((*this)(plane.n), plane.d));
}

uint32_t MeshBuilder::point(Vec3 p) {
  const auto [at, is_new] = points_.emplace(p, uint32_t(mesh_.points.size()));
  if (is_new) mesh_.points.push_back(p);
  return at->second;
}

uint32_t MeshBuilder::facet(const Plane& plane) {
  const auto [at, is_new] = facets_.emplace(plane, uint32_t(mesh_.facets.size()));
  if (is_new) mesh_.facets.push_back(plane);
  return at->second;
}

uint32_t MeshBuilder::facet_of(uint32_t a, uint32_t b, uint32_t c) {
  const Vec3 p = mesh_.points[a];
  Vec3 n = unit_across(mesh_.points[b] - p, mesh_.points[c] - p);
  // Without area any plane through the corners will do.
  if (n == Vec3{}) {
    const Vec3 along = mesh_.points[b] - p;
    n = unit_across(along, std::abs(along.x) <= std::abs(along.z) ? Vec3{1, 0, 0} : Vec3{0, 0, 1});
  }
  return facet({n, dot(n, p)});
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t facet) {
  if (a != b && b != c && c != a) mesh_.triangles.push_back({{a, b, c}, facet});
}

TriangleMesh MeshBuilder::finish() && {
  for (const Vec3 p : mesh_.points)
    if (!is_finite(p)) return {};
  for (const Plane& plane : mesh_.facets)
    if (!is_finite(plane.n) || !std::isfinite(plane.d)) return {};
  for (const TriangleMesh::Triangle& triangle : mesh_.triangles) {
    const Plane& plane = mesh_.facets[triangle.facet];
    for (const uint32_t corner : triangle.corners)
      mesh_.rise = std::max(mesh_.rise, std::abs(dot(plane.n, mesh_.points[corner]) - plane.d));
  }
  return std::move(mesh_);
}

}  // namespace whittle

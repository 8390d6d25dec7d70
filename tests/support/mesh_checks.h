// What a solid's mesh promises, checked without any of what made it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "boundary/solid_mesh.h"

namespace whittle {

/// Empty if every edge is there exactly once each way and the triangles at every corner are one
/// fan; else what is wrong.
inline std::string manifold_fault(const SolidMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) {
      const std::array<uint32_t, 3>& c = mesh.triangles[t].corners;
      if (c[i] >= mesh.corners.size()) return "a corner that is not there";
      if (!edges.insert({{c[i], c[(i + 1) % 3]}, c[(i + 2) % 3]}).second)
        return "an edge twice one way";
    }
  for (const auto& [edge, opposite] : edges)
    if (!edges.contains({edge.second, edge.first})) return "an edge without its other side";
  // Around a corner: from the triangle (corner, a, b) on to (corner, b, c), until it comes back.
  std::vector<uint32_t> degree(mesh.corners.size()), start(mesh.corners.size());
  for (const auto& [edge, opposite] : edges) {
    ++degree[edge.first];
    start[edge.first] = edge.second;
  }
  for (uint32_t corner = 0; corner < mesh.corners.size(); ++corner) {
    if (degree[corner] == 0) return "a corner without triangles";
    uint32_t steps = 0, at = start[corner];
    do {
      at = edges.at({corner, at});
      ++steps;
    } while (at != start[corner] && steps <= degree[corner]);
    if (steps != degree[corner]) return "a corner with two fans";
  }
  return "";
}

inline double volume(const SolidMesh& mesh) {
  if (mesh.corners.empty()) return 0;
  const Vec3 middle = mesh.corners[0];
  double six = 0;
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    six += dot(mesh.corners[a] - middle, cross(mesh.corners[b] - middle, mesh.corners[c] - middle));
  }
  return six / 6;
}

inline double surface(const SolidMesh& mesh) {
  double sum = 0;
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const Vec3 a = mesh.corners[triangle.corners[0]], b = mesh.corners[triangle.corners[1]],
               c = mesh.corners[triangle.corners[2]];
    sum += length(cross(b - a, c - a)) / 2;
  }
  return sum;
}

/// How often the mesh winds around a point that is on none of its triangles: the sum of their solid
/// angles (Van Oosterom and Strackee 1983).
inline int winding(const SolidMesh& mesh, Vec3 p) {
  double sum = 0;
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const Vec3 a = mesh.corners[triangle.corners[0]] - p, b = mesh.corners[triangle.corners[1]] - p,
               c = mesh.corners[triangle.corners[2]] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return int(std::lround(sum / (4 * std::numbers::pi)));
}

}  // namespace whittle

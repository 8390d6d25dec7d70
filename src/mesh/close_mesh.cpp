#include "mesh/close_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "mesh/cut_face.h"
#include "mesh/find_facets.h"
#include "mesh/mend_cracks.h"
#include "mesh/remove_films.h"
#include "mesh/turn_faces.h"
#include "mesh/turn_parts.h"
#include "mesh/weld_points.h"

namespace whittle {
namespace {

bool is_near(Vec3 p) {
  return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest;
}

/// Half a unit of the last of so many digits of the largest coordinate.
double digit_error(const Box& box, int digits) {
  const double largest = max_component(max(abs(box.lo), abs(box.hi)));
  if (digits <= 0 || !(largest > 0)) return 0;
  return 0.5 * std::pow(10, std::floor(std::log10(largest)) + 1 - digits);
}

/// Triangles without those of no extent.
std::vector<Corners> cut_faces(const RawMesh& raw, const std::vector<uint32_t>& first) {
  std::vector<Corners> triangles;
  const auto are_near = [&](const auto& corners) {
    return std::ranges::all_of(corners, [&](uint32_t c) { return is_near(raw.points[c]); });
  };
  std::vector<Corners> cut;
  std::vector<uint32_t> loop;
  for (const std::vector<uint32_t>& face : raw.faces) {
    if (!are_near(face)) continue;
    loop.clear();
    for (const uint32_t corner : face)
      if (loop.empty() || loop.back() != first[corner]) loop.push_back(first[corner]);
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    cut.clear();
    cut_face(raw.points, loop, cut);
    for (const Corners& t : cut)
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  triangles.reserve(triangles.size() + raw.triangles.size());
  for (const Corners& t : raw.triangles) {
    if (!are_near(t)) continue;
    const Corners welded = {first[t[0]], first[t[1]], first[t[2]]};
    if (welded[0] != welded[1] && welded[1] != welded[2] && welded[2] != welded[0])
      triangles.push_back(welded);
  }
  return triangles;
}

}  // namespace

ClosedMesh close_mesh(const RawMesh& raw, int digits) {
  ClosedMesh closed;
  TriangleMesh& mesh = closed.mesh;
  Box box;
  for (const Vec3& p : raw.points)
    if (is_near(p)) box.include(p);
  if (box.is_empty()) return closed;
  const double error = digit_error(box, digits);
  // Corners that are off by an error each, and a plane by the errors of its own.
  const double tolerance = std::max(2 * error, 1e-12 * box.diagonal());
  std::vector<Corners> triangles;
  if (raw.is_closed) {
    triangles = raw.triangles;
  } else {
    const std::vector<uint32_t> first = weld_points(raw.points, error);
    triangles = cut_faces(raw, first);
    remove_films(triangles, raw.points.size());
    MeshParts parts = turn_faces(raw.points, triangles);
    // A corner may be off by an error along each axis, and so may the edge that it is to lie on.
    const double reach = std::numbers::sqrt3 * tolerance;
    constexpr int kPasses = 2;
    for (int pass = 0; pass < kPasses && parts.open_edges > 0; ++pass) {
      if (!mend_cracks(raw.points, triangles, reach)) break;
      remove_films(triangles, raw.points.size());
      const size_t turned = parts.turned;
      parts = turn_faces(raw.points, triangles);
      parts.turned += turned;
    }
    closed.open_edges = parts.open_edges;
    closed.first_open = parts.first_open;
    closed.turned_faces = parts.turned;
    turn_parts(raw.points, triangles, parts);
    size_t kept = 0;
    for (size_t t = 0; t < triangles.size(); ++t)
      if (!parts.is_open[parts.part_of[t]]) triangles[kept++] = triangles[t];
    triangles.resize(kept);
  }
  // Only the points that are used, in their order.
  std::vector<uint32_t> number(raw.points.size(), UINT32_MAX);
  for (const Corners& t : triangles)
    for (const uint32_t corner : t) number[corner] = 0;
  for (size_t i = 0; i < raw.points.size(); ++i) {
    if (number[i] == UINT32_MAX) continue;
    number[i] = uint32_t(mesh.points.size());
    mesh.points.push_back(raw.points[i]);
  }
  mesh.triangles.reserve(triangles.size());
  for (const Corners& t : triangles)
    mesh.triangles.push_back({{number[t[0]], number[t[1]], number[t[2]]}, 0});
  find_facets(mesh, tolerance);
  return closed;
}

}  // namespace whittle

#include "mesh/close_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "mesh/cut_face.h"
#include "mesh/find_facets.h"
#include "mesh/turn_faces.h"
#include "mesh/weld_points.h"

namespace whittle {
namespace {

/// Products of three coordinates beyond this are no numbers any more.
constexpr double kFarthest = 1e75;

bool is_near(Vec3 p) {
  return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest;
}

/// Half a unit of the last of so many digits of the largest coordinate.
double digit_error(const Box& box, int digits) {
  const double largest = max_component(max(abs(box.lo), abs(box.hi)));
  if (digits <= 0 || !(largest > 0)) return 0;
  return 0.5 * std::pow(10, std::floor(std::log10(largest)) + 1 - digits);
}

double volume_of(const std::vector<Vec3>& points, const Corners& t, Vec3 origin) {
  return dot(points[t[0]] - origin, cross(points[t[1]] - origin, points[t[2]] - origin)) / 6;
}

/// The winding number of some triangles about a point: the sum of the solid angles they are seen at
/// (van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983).
double winding_of(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                  const std::vector<uint32_t>& part_of, const std::vector<uint8_t>& counts,
                  Vec3 p) {
  double sum = 0;
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (!counts[part_of[t]]) continue;
    const Vec3 a = points[triangles[t][0]] - p, b = points[triangles[t][1]] - p,
               c = points[triangles[t][2]] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
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

/// Removes pairs of triangles that lie on one another, back to back or face to face.
void remove_films(std::vector<Corners>& triangles) {
  struct Entry {
    Corners sorted;
    uint32_t triangle;
    bool even;
  };
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    Corners c = triangles[t];
    bool even = true;
    const auto order = [&](size_t i, size_t j) {
      if (c[i] > c[j]) std::swap(c[i], c[j]), even = !even;
    };
    order(0, 1), order(1, 2), order(0, 1);
    entries.push_back({c, t, even});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle;
  });
  std::vector<uint8_t> is_gone(triangles.size(), 0);
  for (size_t i = 0; i < entries.size();) {
    std::vector<uint32_t> waiting[2];
    size_t k = i;
    for (; k < entries.size() && entries[k].sorted == entries[i].sorted; ++k) {
      std::vector<uint32_t>& against = waiting[entries[k].even ? 0 : 1];
      if (against.empty()) {
        waiting[entries[k].even ? 1 : 0].push_back(entries[k].triangle);
      } else {
        is_gone[against.back()] = is_gone[entries[k].triangle] = 1;
        against.pop_back();
      }
    }
    i = k;
  }
  size_t kept = 0;
  for (size_t t = 0; t < triangles.size(); ++t)
    if (!is_gone[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

/// Turns the parts that are inside out: see close_mesh().
void turn_parts(const std::vector<Vec3>& points, std::vector<Corners>& triangles,
                const MeshParts& parts) {
  const size_t count = parts.is_open.size();
  if (triangles.empty()) return;
  const Vec3 origin = points[triangles[0][0]];
  std::vector<double> volume(count, 0);
  std::vector<uint32_t> corner_of(count, 0);
  for (size_t t = 0; t < triangles.size(); ++t) {
    volume[parts.part_of[t]] += volume_of(points, triangles[t], origin);
    corner_of[parts.part_of[t]] = triangles[t][0];
  }
  double all = 0;
  for (size_t i = 0; i < count; ++i)
    if (!parts.is_open[i]) all += volume[i];
  std::vector<uint8_t> turned(count, all < 0);
  // Where there are very many parts, files do not come with cavities in them.
  constexpr size_t kMostParts = 1000;
  std::vector<uint8_t> others(count);
  for (size_t i = 0; i < count && count <= kMostParts; ++i) {
    if (parts.is_open[i] || (volume[i] < 0) == bool(turned[i])) continue;
    for (size_t k = 0; k < count; ++k) others[k] = k != i && !parts.is_open[k];
    const double around =
        winding_of(points, triangles, parts.part_of, others, points[corner_of[i]]);
    if (std::fabs(around) < 0.5) turned[i] = !turned[i];
  }
  for (size_t t = 0; t < triangles.size(); ++t)
    if (turned[parts.part_of[t]]) std::swap(triangles[t][1], triangles[t][2]);
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
    remove_films(triangles);
    const MeshParts parts = turn_faces(raw.points, triangles);
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

#include "mesh/find_facets.h"

#include <algorithm>
#include <cmath>

#include "base/box.h"
#include "mesh/edges.h"

namespace whittle {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// Twice the area, as a vector along the normal.
Vec3 area_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
  const Vec3 a = mesh.points[t.corners[0]];
  return cross(mesh.points[t.corners[1]] - a, mesh.points[t.corners[2]] - a);
}

double longest_edge(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
  const Vec3 a = mesh.points[t.corners[0]], b = mesh.points[t.corners[1]],
             c = mesh.points[t.corners[2]];
  return std::max(length(b - a), std::max(length(c - b), length(a - c)));
}

/// Unit; for a triangle of no area any that is square to its longest edge.
Vec3 normal_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
  const Vec3 area = area_of(mesh, t);
  // Of numbers smaller than this the inverse is none.
  constexpr double kNoArea = 1e-300;
  if (length(area) > kNoArea) return normalize(area);
  const Vec3 a = mesh.points[t.corners[0]], b = mesh.points[t.corners[1]],
             c = mesh.points[t.corners[2]];
  Vec3 along = b - a;
  for (const Vec3 edge : {c - b, a - c})
    if (length(edge) > length(along)) along = edge;
  along = along * (length(along) > kNoArea ? 1 / length(along) : 0);
  const Vec3 across = std::fabs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalize(across - along * dot(across, along));
}

/// Of every triangle its neighbours over edges that only two triangles share.
std::vector<Corners> neighbours_of(const TriangleMesh& mesh) {
  std::vector<Corners> corners;
  corners.reserve(mesh.triangles.size());
  for (const TriangleMesh::Triangle& t : mesh.triangles) corners.push_back(t.corners);
  std::vector<Corners> neighbours(corners.size(), Corners{kNone, kNone, kNone});
  for_each_edge(corners, mesh.points.size(),
                [&](uint32_t, uint32_t, std::span<const EdgeUse> uses) {
                  if (uses.size() != 2) return;
                  for (size_t i = 0; i < 2; ++i) {
                    Corners& own = neighbours[uses[i].triangle];
                    *std::find(own.begin(), own.end(), kNone) = uses[1 - i].triangle;
                  }
                });
  return neighbours;
}

/// Large ones first, but only by powers of two, for which counting suffices.
std::vector<uint32_t> by_area(const TriangleMesh& mesh) {
  constexpr int kSteps = 512;
  std::vector<uint32_t> count(kSteps + 1, 0), step_of(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = length(area_of(mesh, mesh.triangles[t]));
    step_of[t] =
        uint32_t(area > 0 ? std::clamp(kSteps / 2 - std::ilogb(area), 0, kSteps - 1) : kSteps - 1);
    ++count[step_of[t] + 1];
  }
  for (int i = 0; i < kSteps; ++i) count[size_t(i) + 1] += count[size_t(i)];
  std::vector<uint32_t> order(mesh.triangles.size());
  for (uint32_t t = 0; t < order.size(); ++t) order[count[step_of[t]]++] = t;
  return order;
}

class FacetFinder {
 public:
  FacetFinder(TriangleMesh& mesh, double tolerance)
      : mesh_(mesh), tolerance_(tolerance), neighbours_(neighbours_of(mesh)) {}

  void run() {
    mesh_.facets.clear();
    mesh_.rise = 0;
    for (TriangleMesh::Triangle& t : mesh_.triangles) t.facet = kNone;
    for (const uint32_t seed : by_area(mesh_))
      if (mesh_.triangles[seed].facet == kNone) grow(seed);
  }

 private:
  void grow(uint32_t seed) {
    const auto facet = uint32_t(mesh_.facets.size());
    const Vec3 n = normal_of(mesh_, mesh_.triangles[seed]);
    const double d = dot(n, mesh_.points[mesh_.triangles[seed].corners[0]]);
    members_.assign(1, seed);
    mesh_.triangles[seed].facet = facet;
    for (size_t i = 0; i < members_.size(); ++i)
      for (const uint32_t next : neighbours_[members_[i]])
        if (next != kNone && mesh_.triangles[next].facet == kNone && lies_in(next, n, d)) {
          mesh_.triangles[next].facet = facet;
          members_.push_back(next);
        }
    mesh_.facets.push_back(plane_of_members(n));
  }

  bool lies_in(uint32_t triangle, Vec3 n, double d) const {
    const TriangleMesh::Triangle& t = mesh_.triangles[triangle];
    for (const uint32_t corner : t.corners)
      if (!(std::fabs(dot(n, mesh_.points[corner]) - d) <= tolerance_)) return false;
    const Vec3 area = area_of(mesh_, t);
    const double size = length(area);
    // The height of a sliver over its longest edge is in its digits.
    return dot(area, n) > 0.5 * size || size <= 4 * tolerance_ * longest_edge(mesh_, t);
  }

  /// `seed`: the normal of the first member.
  Plane plane_of_members(Vec3 seed) {
    Vec3 area;
    Box box;
    for (const uint32_t member : members_) {
      area += area_of(mesh_, mesh_.triangles[member]);
      for (const uint32_t corner : mesh_.triangles[member].corners)
        box.include(mesh_.points[corner]);
    }
    Plane plane{normalize(area), 0};
    // Where there is hardly any area it tells nothing, not even a number.
    if (!(dot(plane.n, seed) > 0.5) || !is_finite(plane.n)) plane.n = seed;
    const Vec3 size = box.size();
    const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
    if (size[axis] <= tolerance_ && std::fabs(plane.n[axis]) > 0.5) {
      const double sign = plane.n[axis] > 0 ? 1 : -1;
      plane.n = {};
      plane.n[axis] = sign;
    }
    double low = kInfinity, high = -kInfinity;
    for (const uint32_t member : members_)
      for (const uint32_t corner : mesh_.triangles[member].corners) {
        const double at = dot(plane.n, mesh_.points[corner]);
        low = std::min(low, at);
        high = std::max(high, at);
      }
    plane.d = low == high ? low : low + (high - low) / 2;
    mesh_.rise = std::max(mesh_.rise, high - plane.d);
    return plane;
  }

  TriangleMesh& mesh_;
  double tolerance_;
  std::vector<Corners> neighbours_;
  std::vector<uint32_t> members_;
};

}  // namespace

void find_facets(TriangleMesh& mesh, double tolerance) {
  FacetFinder(mesh, tolerance).run();
}

}  // namespace whittle

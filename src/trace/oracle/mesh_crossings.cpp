#include "trace/oracle/mesh_crossings.h"

#include <algorithm>
#include <cmath>

#include "trace/oracle/span.h"

namespace whittle {

WorldMesh world_mesh(const TriangleMesh& mesh, const Affine& world_from_mesh) {
  WorldMesh world;
  for (const Vec3& p : mesh.points) world.points.push_back(world_from_mesh.point(p));
  const bool turned = world_from_mesh.determinant() < 0;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    world.triangles.push_back({t.corners, t.facet});
    if (turned) std::swap(world.triangles.back().corners[1], world.triangles.back().corners[2]);
  }
  return world;
}

void mesh_crossings(const Surfaces& surfaces, size_t solid, const WorldMesh& mesh, Vec3 origin,
                    Vec3 direction, std::vector<MeshCrossing>& out) {
  struct Met {
    double t;
    int growth;  ///< of the winding number
    Vec3 normal;
  };
  std::vector<Met> met;
  // Which side of the line an edge passes on, the same for both triangles at it.
  const auto passes_left = [&](uint32_t a, uint32_t b) {
    const bool swapped = a > b;
    const Vec3 p = mesh.points[swapped ? b : a] - origin, q = mesh.points[swapped ? a : b] - origin;
    return (dot(direction, cross(p, q)) > 0) != swapped;
  };
  for (const WorldMesh::Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const bool left = passes_left(a, b);
    if (passes_left(b, c) != left || passes_left(c, a) != left) continue;
    const PlaneCrossing at =
        plane_crossing(surfaces, surfaces.faces_of(solid)[triangle.face], origin, direction);
    if (std::isfinite(at.t)) met.push_back({at.t, left ? -1 : 1, at.normal});
  }
  std::ranges::sort(met, {}, &Met::t);
  int winding = 0;
  for (size_t first = 0; first < met.size();) {
    const int before = winding;
    size_t last = first;
    for (; last < met.size() && met[last].t == met[first].t; ++last) winding += met[last].growth;
    if ((before != 0) != (winding != 0)) {
      // Of several triangles there, one that was crossed the same way.
      const auto its =
          std::find_if(met.begin() + std::ptrdiff_t(first), met.begin() + std::ptrdiff_t(last),
                       [&](const Met& m) { return (m.growth > 0) == (winding > before); });
      const Vec3 outward =
          dot(its->normal, direction) * (winding != 0 ? 1 : -1) > 0 ? -its->normal : its->normal;
      out.push_back({met[first].t, winding != 0, outward});
    }
    first = last;
  }
}

}  // namespace whittle

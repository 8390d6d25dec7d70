#include "boundary/closed_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lower/lower.h"

namespace whittle {
namespace {

/// Faces keep their normals; how far out they are, their corners say.
TriangleMesh triangle_mesh(SolidMesh solid) {
  TriangleMesh mesh;
  mesh.points = std::move(solid.corners);
  mesh.triangles.reserve(solid.triangles.size());
  mesh.facets.reserve(solid.faces.size());
  for (const SolidMesh::Face& face : solid.faces) mesh.facets.push_back({face.outward, 0});
  std::vector<size_t> corners(solid.faces.size());
  const auto height = [&](const TriangleMesh::Triangle& t, size_t k) {
    return dot(mesh.facets[t.facet].n, mesh.points[t.corners[k]]);
  };
  for (const SolidMesh::Triangle& triangle : solid.triangles) {
    const TriangleMesh::Triangle t{triangle.corners, triangle.face};
    mesh.triangles.push_back(t);
    corners[t.facet] += 3;
    for (size_t k = 0; k < 3; ++k) mesh.facets[t.facet].d += height(t, k);
  }
  for (size_t i = 0; i < corners.size(); ++i)
    mesh.facets[i].d /= double(std::max<size_t>(corners[i], 1));
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      mesh.rise = std::fmax(mesh.rise, std::fabs(height(t, k) - mesh.facets[t.facet].d));
  return mesh;
}

}  // namespace

Result<TriangleMesh> closed_mesh(const Model& model, const Workers& workers,
                                 const BoundarySettings& settings, BoundaryStats* stats) {
  const Result<Scene> scene = lower(model, &workers);
  if (!scene) return scene.error();
  Result<SolidMesh> solid = evaluate_solid(*scene, workers, stats, settings);
  if (!solid) return solid.error();
  return triangle_mesh(*std::move(solid));
}

}  // namespace whittle

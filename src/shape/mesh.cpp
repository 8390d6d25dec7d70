#include "shape/mesh.h"

#include "shape/points.h"

namespace whittle {
namespace {

/// A plate's thickness, or about a third of a round body's: twice its volume over its area.
double mean_thickness(const TriangleMesh& mesh, const Affine& map) {
  double volume = 0, area = 0;
  const Vec3 origin = map.point(mesh.points.empty() ? Vec3{} : mesh.points[0]);
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3 a = map.point(mesh.points[t.corners[0]]) - origin,
               b = map.point(mesh.points[t.corners[1]]) - origin,
               c = map.point(mesh.points[t.corners[2]]) - origin;
    volume += dot(a, cross(b, c)) / 6;
    area += length(cross(b - a, c - a)) / 2;
  }
  return area > 0 ? 2 * std::fabs(volume) / area : 0;
}

}  // namespace

double volume(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0;
  double six_times = 0;
  const Vec3 origin = mesh.points[0];
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const auto corner = [&](size_t k) { return mesh.points[t.corners[k]] - origin; };
    six_times += dot(corner(0), cross(corner(1), corner(2)));
  }
  return six_times / 6;
}

bool Mesh::is_empty() const {
  return !surface || surface->triangles.empty();
}

uint64_t Mesh::facet_count() const {
  return surface ? surface->triangles.size() : 0;
}

std::vector<Plane> Mesh::facet_planes() const {
  return surface->facets;
}

size_t Mesh::plane_count() const {
  return surface->facets.size();
}

std::vector<Vec3> Mesh::outline() const {
  return surface->points;
}

std::vector<Box> Mesh::facet_boxes() const {
  std::vector<Box> boxes(surface->facets.size());
  for (const TriangleMesh::Triangle& t : surface->triangles)
    for (const uint32_t corner : t.corners) boxes[t.facet].include(surface->points[corner]);
  return boxes;
}

Box Mesh::box(const Affine& map) const {
  return box_of(surface->points, map);
}

Box Mesh::finite_box(const Affine& map) const {
  return transform(map, box({}));
}

Extent Mesh::extent(std::span<const Vec3> outline, std::span<const Plane>,
                    const Affine& map) const {
  const Box box = box_of(outline, map);
  return {box.center(), box.diagonal() / 2, mean_thickness(*surface, map)};
}

}  // namespace whittle

#include "evaluate/solid_parts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/box.h"
#include "base/disjoint_sets.h"
#include "evaluate/convex_hull.h"
#include "evaluate/convex_pieces.h"
#include "evaluate/extrusions.h"
#include "evaluate/flat_values.h"
#include "shape/build_planes.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// By fans of triangles, about a point of it.
double volume_of(const Polyhedron& solid) {
  double sum = 0;
  const Vec3 o = solid.points.front();
  for (const auto& face : solid.faces) {
    for (size_t k = 2; k < face.size(); ++k) {
      sum += dot(solid.points[face[0]] - o,
                 cross(solid.points[face[k]] - o, solid.points[face[k - 1]] - o));
    }
  }
  return sum / 6;
}

/// Whether the surface is bent inward at some edge, by more than what counts as flat.
bool has_dent(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.facets.size());
  std::unordered_map<uint64_t, uint32_t> by_edge;
  const auto at = [&](uint32_t corner) { return mesh.points[corner]; };
  const auto edge = [](uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; };
  Box box;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [c, facet] = mesh.triangles[i];
    for (size_t k = 0; k < 3; ++k) {
      box.include(at(c[k]));
      by_edge[edge(c[k], c[(k + 1) % 3])] = i;
    }
    normals[facet] += cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  }
  for (Vec3& normal : normals) normal = normalize(normal);
  const double least = kSamePlane * box.diagonal();
  for (const auto& [c, facet] : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const auto twin = by_edge.find(edge(c[(k + 1) % 3], c[k]));
      if (twin == by_edge.end()) continue;
      const TriangleMesh::Triangle& other = mesh.triangles[twin->second];
      if (other.facet == facet) continue;
      for (const uint32_t corner : other.corners)
        if (dot(normals[facet], at(corner) - at(c[k])) > least) return true;
    }
  }
  return false;
}

/// Whether a mesh is its own hull: it has no dent, and fills it.
bool is_convex(const TriangleMesh& mesh) {
  if (has_dent(mesh)) return false;
  const std::optional<Polyhedron> hull = solid_hull(mesh.points);
  if (!hull) return false;
  constexpr double kSame = 1e-6;
  const double whole = volume_of(*hull);
  return std::fabs(volume(mesh) - whole) <= kSame * whole;
}

SolidPart extruded(std::span<const Vec2> outline, const LinearExtrude& how) {
  const Affine map = placement(how);
  SolidPart part;
  for (const double z : {0.0, how.height})
    for (const Vec2 p : outline) part.points.push_back(map.point({p.x, p.y, z}));
  return part;
}

/// As few convex outlines as triangles can be joined to.
std::vector<Contour> convex_outlines(const Polygons& polygons) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto before = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  const std::vector<std::array<Vec2, 3>> cut = triangulate(polygons);
  std::vector<Vec2> corners;
  for (const auto& triangle : cut) corners.insert(corners.end(), triangle.begin(), triangle.end());
  std::sort(corners.begin(), corners.end(), before);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const Vec2 p : corners) points.push_back({p.x, p.y, 0});
  for (const auto& triangle : cut) {
    TriangleMesh::Triangle& t = triangles.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const auto place = std::lower_bound(corners.begin(), corners.end(), triangle[k], before);
      t.corners[k] = uint32_t(place - corners.begin());
    }
  }
  std::vector<Contour> outlines;
  for (const std::vector<uint32_t>& piece : convex_pieces(points, triangles)) {
    Contour& outline = outlines.emplace_back();
    for (const uint32_t i : piece) outline.push_back(corners[i]);
  }
  return outlines;
}

/// By shell, its triangles as a mesh of their own.
std::vector<TriangleMesh> split(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<TriangleMesh> parts(shells.count);
  std::vector<uint32_t> numbers(mesh.points.size());
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    if (shells.of_point[i] == shells.count) continue;
    TriangleMesh& part = parts[shells.of_point[i]];
    numbers[i] = uint32_t(part.points.size());
    part.points.push_back(mesh.points[i]);
  }
  std::vector<uint32_t> facets(mesh.facets.size());
  std::vector<uint32_t> last_shell(mesh.facets.size(), shells.count);
  std::vector<std::vector<TriangleMesh::Triangle>> by_shell(shells.count);
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    by_shell[shells.of_point[t.corners[0]]].push_back(t);
  for (uint32_t shell = 0; shell < shells.count; ++shell) {
    TriangleMesh& part = parts[shell];
    for (TriangleMesh::Triangle t : by_shell[shell]) {
      if (last_shell[t.facet] != shell) {
        last_shell[t.facet] = shell;
        facets[t.facet] = uint32_t(part.facets.size());
        part.facets.push_back(mesh.facets[t.facet]);
      }
      t.facet = facets[t.facet];
      for (uint32_t& corner : t.corners) corner = numbers[corner];
      part.triangles.push_back(t);
    }
  }
  return parts;
}

}  // namespace

SolidPart part_of(const Shape& shape, bool wants_surface, Budget& budget) {
  SolidPart part;
  if (is_empty(shape) || !is_flat(shape)) return part;
  // There are not many more corners than facets.
  if (!budget.work(facet_count(shape) + 8)) return part;
  part.points = outline(shape);
  const TriangleMesh* const mesh = boundary(shape);
  if (mesh && wants_surface && !is_convex(*mesh)) part.triangles = mesh->triangles;
  return part;
}

Shells shells_of(const SolidPart& part) {
  const size_t count = part.points.size();
  DisjointSets joined(count);
  std::vector<bool> is_corner(count);
  for (const TriangleMesh::Triangle& t : part.triangles) {
    for (const uint32_t corner : t.corners) {
      is_corner[corner] = true;
      joined.join(corner, t.corners[0]);
    }
  }
  Shells shells;
  std::vector<uint32_t> numbers(count, UINT32_MAX);
  shells.of_point.resize(count, UINT32_MAX);
  for (uint32_t i = 0; i < count; ++i) {
    if (!is_corner[i]) continue;
    uint32_t& number = numbers[joined.find(i)];
    if (number == UINT32_MAX) number = shells.count++;
    shells.of_point[i] = number;
  }
  std::replace(shells.of_point.begin(), shells.of_point.end(), UINT32_MAX, shells.count);
  return shells;
}

std::vector<SolidPart> parts_of(const TriangleMesh& boundary, bool wants_surface) {
  if (boundary.triangles.empty()) return {};
  if (!wants_surface) return {{.points = boundary.points}};
  const SolidPart whole{.points = boundary.points, .triangles = boundary.triangles};
  std::vector<TriangleMesh> shells = split(boundary, shells_of(whole));
  const auto is_hollow = [](const TriangleMesh& shell) { return volume(shell) < 0; };
  if (std::any_of(shells.begin(), shells.end(), is_hollow)) return {whole};
  std::vector<SolidPart> parts;
  for (TriangleMesh& shell : shells) {
    SolidPart& part = parts.emplace_back();
    if (!is_convex(shell)) part.triangles = std::move(shell.triangles);
    part.points = std::move(shell.points);
  }
  return parts;
}

std::vector<SolidPart> extruded_parts(const Polygons& polygons, const LinearExtrude& how,
                                      bool wants_surface, Budget& budget) {
  std::vector<SolidPart> parts;
  if (polygons.is_empty() || !budget.work(2 * corner_count(polygons))) return parts;
  if (!wants_surface) {
    for (const Contour& contour : polygons.contours) parts.push_back(extruded(contour, how));
    return parts;
  }
  if (const std::optional<Contour> outline = convex_outline(polygons)) {
    parts.push_back(extruded(*outline, how));
    return parts;
  }
  for (const Contour& outline : convex_outlines(polygons)) parts.push_back(extruded(outline, how));
  return parts;
}

void transform(const Affine& map, SolidPart& part) {
  if (map == Affine{}) return;
  for (Vec3& p : part.points) p = map.point(p);
  if (map.determinant() < 0)
    for (TriangleMesh::Triangle& t : part.triangles) std::swap(t.corners[1], t.corners[2]);
}

}  // namespace whittle

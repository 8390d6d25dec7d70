// Boundaries of the public API.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "boundary/face_loops.h"
#include "whittle/api.h"
#include "whittle/export_format.h"
#include "whittle/output.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

/// Triangles face by face.
void sort_by_face(SolidMesh& mesh) {
  std::stable_sort(mesh.triangles.begin(), mesh.triangles.end(),
                   [](const auto& a, const auto& b) { return a.face < b.face; });
}

BoundaryMesh boundary_of(const SolidMesh& mesh) {
  BoundaryMesh made;
  made.corners.reserve(mesh.corners.size());
  for (const Vec3& corner : mesh.corners) made.corners.push_back(to_point(corner));
  for (const SolidMesh::Face& face : mesh.faces) {
    BoundaryMesh::Face& its = made.faces.emplace_back();
    its.id = face.owner;
    its.normal = to_point(face.outward);
    const Rgba& c = face.color;
    if (c.is_valid()) its.color = std::array{c.r, c.g, c.b, c.a};
  }
  made.triangles.reserve(mesh.triangles.size());
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    BoundaryMesh::Face& face = made.faces[triangle.face];
    if (face.triangle_count++ == 0) face.first_triangle = uint32_t(made.triangles.size());
    made.triangles.push_back(triangle.corners);
  }
  std::vector<std::vector<std::vector<uint32_t>>> loops = face_loops(mesh);
  for (size_t i = 0; i < loops.size(); ++i) made.faces[i].loops = std::move(loops[i]);
  return made;
}

/// Whether every edge of a triangle is there exactly once each way, between two corners.
bool is_closed(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::vector<std::array<uint32_t, 2>> edges, back;
  edges.reserve(3 * triangles.size());
  back.reserve(3 * triangles.size());
  for (const std::array<uint32_t, 3>& corners : triangles)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = corners[i], b = corners[(i + 1) % 3];
      if (a == b) return false;
      edges.push_back({a, b});
      back.push_back({b, a});
    }
  std::sort(edges.begin(), edges.end());
  std::sort(back.begin(), back.end());
  return edges == back && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

/// What is written of it; all numbers are looked at, as anybody can have made it.
SolidMesh mesh_of(const BoundaryMesh& boundary) {
  SolidMesh mesh;
  for (const Point& corner : boundary.corners) {
    if (!is_finite(mesh.corners.emplace_back(to_vec3(corner))))
      refuse("the corners of a boundary must be finite");
  }
  for (const BoundaryMesh::Face& face : boundary.faces) {
    const auto number = uint32_t(mesh.faces.size());
    SolidMesh::Face& its = mesh.faces.emplace_back();
    its.outward = to_vec3(face.normal);
    its.owner = face.id;
    if (face.color) {
      const auto& [r, g, b, a] = *face.color;
      its.color = {r, g, b, a};
    }
    const size_t first = face.first_triangle, count = face.triangle_count;
    if (first != mesh.triangles.size() || first + count > boundary.triangles.size())
      refuse("the faces of a boundary must have its triangles in a row");
    for (size_t i = first; i < first + count; ++i) {
      for (const uint32_t corner : boundary.triangles[i])
        if (corner >= mesh.corners.size())
          refuse("the triangles of a boundary must have its corners");
      mesh.triangles.push_back({boundary.triangles[i], number});
    }
  }
  if (mesh.triangles.size() != boundary.triangles.size())
    refuse("the faces of a boundary must have its triangles in a row");
  if (!is_closed(boundary.triangles))
    refuse("every edge of a boundary must be there once each way");
  return mesh;
}

}  // namespace

BoundaryMesh Solid::boundary(int threads) const {
  return *boundary(Control{}, threads);
}

std::optional<BoundaryMesh> Solid::boundary(const Control& control, int threads) const {
  const Workers workers(threads_of(threads));
  if (control.stop.stop_requested()) return std::nullopt;
  SolidMesh mesh =
      value_of(solid_of(state_->model, workers, nullptr,
                        {.paints = {}, .stop = control.stop, .progress = control.progress}));
  if (control.stop.stop_requested()) return std::nullopt;
  sort_by_face(mesh);
  return boundary_of(mesh);
}

void BoundaryMesh::write(const std::string& path) const {
  const Result<ExportFormat> format = export_format_of(path);
  const SolidFormat* solid = format ? std::get_if<SolidFormat>(&*format) : nullptr;
  if (solid == nullptr)
    refuse("'" + path + "' does not end in .stl, .off, .obj, .3mf or .amf, as files of solids do");
  value_of(write_output(path, value_of(write_solid(mesh_of(*this), *solid, Workers(0))).bytes));
}

}  // namespace whittle

#include "evaluate/polyhedra.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "mesh/close_mesh.h"
#include "model/polyhedron.h"

namespace whittle {
namespace {

/// Counter-clockwise faces, as meshes have them.
RawMesh raw_mesh(Polyhedron polyhedron) {
  RawMesh raw;
  raw.points = std::move(polyhedron.points);
  raw.faces = std::move(polyhedron.faces);
  for (auto& face : raw.faces) std::reverse(face.begin(), face.end());
  return raw;
}

/// A polyhedron that is no convex solid, as a mesh.
Shape closed(Polyhedron polyhedron, SourceLocation where, Warnings& warnings) {
  ClosedMesh mesh = close_mesh(raw_mesh(std::move(polyhedron)), kPrintedDigits);
  if (mesh.open_edges > 0) {
    const Vec3 at = mesh.first_open;
    const std::string what = "a polyhedron is not closed";
    const std::string_view part = mesh.mesh.triangles.empty() ? "it" : "the open part of it";
    warnings.add_unsupported(
        what, where,
        fmt::format("polyhedron: {} edges are open, the first at [{:.6g}, {:.6g}, {:.6g}]; {} is "
                    "left out",
                    mesh.open_edges, at.x, at.y, at.z, part),
        what);
  }
  if (mesh.mesh.triangles.empty()) return Mesh{};
  return Mesh{std::make_shared<const TriangleMesh>(std::move(mesh.mesh))};
}

}  // namespace

uint64_t facet_count(const Shape& shape) {
  if (const auto* const sphere = std::get_if<Sphere>(&shape)) {
    // n faces between each two of (n + 1) / 2 rings, and two caps.
    const auto n = static_cast<uint64_t>(sphere->facets);
    return n > 0 ? n * ((n + 1) / 2 - 1) + 2 : 0;
  }
  if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) {
    return cylinder->facets > 0 ? static_cast<uint64_t>(cylinder->facets) + 2 : 0;
  }
  if (const auto* const mesh = std::get_if<Mesh>(&shape)) {
    return mesh->surface ? mesh->surface->triangles.size() : 0;
  }
  const auto* const polyhedron = std::get_if<Polyhedron>(&shape);
  return polyhedron ? polyhedron->faces.size() : 0;
}

void build_polyhedra(Model& model, Budget& budget, Warnings& warnings, SourceLocation& where) {
  for (size_t i = 0; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    ++i;
    if (node.kind != NodeKind::kPrimitive) continue;
    where = node.where;
    Shape& shape = model.primitives[node.payload].shape;
    const uint64_t facets = facet_count(shape);
    if (!budget.spend(facets)) return;
    auto* const polyhedron = std::get_if<Polyhedron>(&shape);
    if (!polyhedron) continue;
    const Verdict verdict = build_planes(*polyhedron);
    if (!verdict.refusal.empty()) {
      shape = closed(std::move(*polyhedron), node.where, warnings);
    } else if (!verdict.remark.empty()) {
      warnings.add("a polyhedron is not quite what its faces say", node.where,
                   "polyhedron: " + verdict.remark);
    }
    // Faces that are not flat have become more.
    if (!budget.spend(std::max(facets, facet_count(shape)) - facets)) return;
  }
}

}  // namespace whittle

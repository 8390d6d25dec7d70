#include "evaluate/polyhedra.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/workers.h"
#include "mesh/close_mesh.h"
#include "shape/build_planes.h"

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

/// Polyhedra of this many facets together are worth the start of other threads.
constexpr uint64_t kWorthThreads = 10'000;

/// What has become of a polyhedron besides its shape.
struct Built {
  std::string remark;  ///< about a convex one
  size_t open_edges = 0;
  Vec3 first_open;
};

Built build(Shape& shape) {
  Polyhedron& polyhedron = std::get<Polyhedron>(shape);
  Built built;
  Verdict verdict = build_planes(polyhedron);
  if (verdict.refusal.empty()) {
    built.remark = std::move(verdict.remark);
    return built;
  }
  ClosedMesh mesh = close_mesh(raw_mesh(std::move(polyhedron)), kPrintedDigits);
  built.open_edges = mesh.open_edges;
  built.first_open = mesh.first_open;
  shape = mesh.mesh.triangles.empty()
              ? Mesh{}
              : Mesh{std::make_shared<const TriangleMesh>(std::move(mesh.mesh))};
  return built;
}

void warn_of(const Built& built, const Shape& shape, SourceLocation where, Warnings& warnings) {
  if (!built.remark.empty()) {
    warnings.add("a polyhedron is not quite what its faces say", where,
                 "polyhedron: " + built.remark);
  }
  if (built.open_edges > 0) {
    const Vec3 at = built.first_open;
    const std::string what = "a polyhedron is not closed";
    const std::string_view part = is_empty(shape) ? "it" : "the open part of it";
    warnings.add_unsupported(
        what, where,
        fmt::format("polyhedron: {} edges are open, the first at [{:.6g}, {:.6g}, {:.6g}]; {} is "
                    "left out",
                    built.open_edges, at.x, at.y, at.z, part),
        what);
  }
}

}  // namespace

void build_polyhedra(Model& model, int threads, Budget& budget, Warnings& warnings,
                     SourceLocation& where) {
  std::vector<uint32_t> polyhedra;  // their nodes
  std::vector<uint64_t> facets;     // and how many each of them has as it is written
  uint64_t all_facets = 0;
  for (size_t i = 0; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    if (node.kind == NodeKind::kPrimitive) {
      where = node.where;
      const Shape& shape = model.primitives[node.payload].shape;
      const uint64_t count = facet_count(shape);
      if (!budget.spend(count)) return;
      if (std::holds_alternative<Polyhedron>(shape)) {
        polyhedra.push_back(uint32_t(i));
        facets.push_back(count);
        all_facets += count;
      }
    }
    ++i;
  }
  const auto shape_of = [&](uint32_t node) -> Shape& {
    return model.primitives[model.nodes[node].payload].shape;
  };
  std::vector<Built> built(polyhedra.size());
  const auto build_some = [&](size_t first, size_t last, size_t) {
    for (size_t k = first; k < last; ++k) built[k] = build(shape_of(polyhedra[k]));
  };
  if (all_facets >= kWorthThreads && threads != 1)
    Workers(threads).for_parts(polyhedra.size(), 1, build_some);
  else
    build_some(0, polyhedra.size(), 0);
  for (size_t k = 0; k < polyhedra.size(); ++k) {
    where = model.nodes[polyhedra[k]].where;
    const Shape& shape = shape_of(polyhedra[k]);
    warn_of(built[k], shape, where, warnings);
    // Faces that are not flat have become more.
    if (!budget.spend(std::max(facets[k], facet_count(shape)) - facets[k])) return;
  }
}

}  // namespace whittle

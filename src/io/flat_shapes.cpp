#include "io/flat_shapes.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "model/polyhedron.h"

namespace whittle {
namespace {

uint64_t facet_count(const Shape& shape) {
  if (const auto* const sphere = std::get_if<Sphere>(&shape)) {
    // n faces between each two of (n + 1) / 2 rings, and two caps.
    const auto n = static_cast<uint64_t>(sphere->facets);
    return n > 0 ? n * ((n + 1) / 2 - 1) + 2 : 0;
  }
  if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) {
    return cylinder->facets > 0 ? static_cast<uint64_t>(cylinder->facets) + 2 : 0;
  }
  const auto* const polyhedron = std::get_if<Polyhedron>(&shape);
  return polyhedron ? polyhedron->faces.size() : 0;
}

}  // namespace

std::optional<Mistake> check_facets(const Model& model, size_t limit) {
  uint64_t total = 0;
  for (const Node& node : model.nodes) {
    if (node.kind != NodeKind::kPrimitive) continue;
    total += facet_count(model.primitives[node.payload].shape);
    if (total > limit) {
      return Mistake{node.where,
                     fmt::format("with this shape the model has {} facets, more than the limit of "
                                 "{}; a smaller $fn gives fewer, --curves smooth none, --limit "
                                 "facets=N raises it",
                                 total, limit)};
    }
  }
  return std::nullopt;
}

std::vector<PolyhedronNote> build_polyhedra(Model& model) {
  std::vector<PolyhedronNote> notes;
  for (const Node& node : model.nodes) {
    if (node.kind != NodeKind::kPrimitive) continue;
    auto* const polyhedron = std::get_if<Polyhedron>(&model.primitives[node.payload].shape);
    if (!polyhedron) continue;
    Verdict verdict = build_planes(*polyhedron);
    if (!verdict.refusal.empty()) {
      notes.push_back({node.where, true, std::move(verdict.refusal)});
    } else if (!verdict.remark.empty()) {
      notes.push_back({node.where, false, std::move(verdict.remark)});
    }
  }
  return notes;
}

}  // namespace whittle

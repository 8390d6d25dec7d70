// What must be evaluated before others can use it: models of their own, and what becomes of them.
#include <utility>

#include "evaluate/evaluator.h"
#include "evaluate/projection.h"
#include "model/instances.h"
#include "shape/shape.h"

namespace whittle {
void Evaluator::open_model(uint32_t i, Frame& frame) {
  frame.mode = Mode::kSolid;
  frame.is_facetted = frame.has_model = true;
  outer_.push_back(std::exchange(out_, {}));
  out_.statement_count = document_.model.statement_count;
  begin_node(NodeKind::kUnion, 0, document_.model.nodes[i]);
}

Model Evaluator::close_model() {
  Model model = std::exchange(out_, std::move(outer_.back()));
  outer_.pop_back();
  model.nodes[0].end = uint32_t(model.nodes.size());
  return model;
}

/// Empty, with a word why, if there is none; or if the budget is spent.
TriangleMesh Evaluator::boundary_of(const Model& model, const Frame& frame) {
  // To find a boundary costs more than to compute with its corners.
  constexpr uint64_t kPerModel = 1000, kPerNode = 20;
  uint64_t work = kPerModel + kPerNode * model.nodes.size();
  for (const Primitive& primitive : model.primitives) work += facet_count(primitive.shape);
  if (model.primitives.empty() || !budget_.work(work)) return {};
  if (!options_.closed_mesh) {
    refuse(frame.node, "what is cut is not evaluated here; it is left out",
           "what is cut is not evaluated here");
    return {};
  }
  if (!bounds(model).bounded) {
    refuse(frame.node, "this solid has no end, so no hull and no projection; it is left out",
           "a solid has no end, so no hull and no projection");
    return {};
  }
  size_t pieces = 0;
  Result<TriangleMesh> mesh = options_.closed_mesh(model, pieces);
  if (!mesh) {
    budget_.refuse("this solid cannot be evaluated: " + mesh.error().message);
    return {};
  }
  // What was cut may leave few triangles.
  constexpr uint64_t kPerTriangle = 10, kPerPiece = 20;
  budget_.work(kPerTriangle * mesh->triangles.size() + kPerPiece * uint64_t(pieces));
  return *std::move(mesh);
}

Polygons Evaluator::shadow_of(const Model& model, const Frame& frame) {
  const std::vector<Contour> outlines = shadow_outlines(boundary_of(model, frame));
  if (outlines.empty() || !budget_.sweep(outlines)) return {};
  return nonzero(outlines);
}

}  // namespace whittle

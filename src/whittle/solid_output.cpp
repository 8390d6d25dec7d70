#include "whittle/solid_output.h"

#include "lower/lower.h"
#include "model/instances.h"

namespace whittle {
namespace {

Error refused(const Model& model, const std::string& why) {
  return {ErrorKind::kInput, model.file + ": error: " + why};
}

}  // namespace

bool has_true_curves(const Model& model) {
  InstanceWalk walk(model);
  while (const Instance* instance = walk.next())
    if (!instance->empty && !is_flat(model.primitives[instance->primitive].shape)) return true;
  return false;
}

Result<SolidMesh> solid_of(const Model& model, const Workers& workers, BoundaryStats* stats) {
  if (model.drawing)
    return refused(model, "the model is flat, not a solid; .svg and .dxf hold what is flat");
  const Result<Scene> scene = lower(model, &workers);
  if (!scene) return scene.error();
  Result<SolidMesh> mesh = evaluate_solid(*scene, workers, stats);
  if (!mesh) {
    return mesh.error().kind == ErrorKind::kInput ? refused(model, mesh.error().message)
                                                  : mesh.error();
  }
  if (mesh->triangles.empty()) return refused(model, "the solid is empty");
  const std::vector<Appearance> appearance = appearances(model);
  for (SolidMesh::Face& face : mesh->faces) face.color = appearance[face.owner].color;
  return mesh;
}

Result<std::vector<std::vector<Vec2>>> drawing_of(const Model& model) {
  if (!model.drawing)
    return refused(model, "the model is not flat; .svg and .dxf hold only what is");
  if (model.drawing->outlines.empty()) return refused(model, "the drawing is empty");
  return model.drawing->outlines;
}

}  // namespace whittle

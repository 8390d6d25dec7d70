#include "whittle/solid_output.h"

#include <array>
#include <map>

#include "lower/lower.h"
#include "model/instances.h"

namespace whittle {
namespace {

Error refused(const Model& model, const std::string& why) {
  return {ErrorKind::kInput, model.file + ": error: " + why};
}

/// By id, a number for each colour there is; none if there is but one.
std::vector<uint32_t> paints_of(const std::vector<Appearance>& looks) {
  std::map<std::array<float, 4>, uint32_t> numbers;
  std::vector<uint32_t> paints{0};  // nobody's
  for (size_t id = 1; id < looks.size(); ++id) {
    const Rgba& c = looks[id].color;
    const auto key =
        c.is_valid() ? std::array{c.r, c.g, c.b, c.a} : std::array{-1.f, 0.f, 0.f, 0.f};
    paints.push_back(numbers.emplace(key, uint32_t(numbers.size())).first->second);
  }
  if (numbers.size() < 2) paints.clear();
  return paints;
}

}  // namespace

bool has_true_curves(const Model& model) {
  InstanceWalk walk(model);
  while (const Instance* instance = walk.next())
    if (!instance->empty && !is_flat(model.primitives[instance->primitive].shape)) return true;
  return false;
}

Result<SolidMesh> solid_of(const Model& model, const Workers& workers, BoundaryStats* stats,
                           BoundarySettings settings) {
  Result<SolidMesh> mesh = solid_or_nothing_of(model, workers, stats, settings);
  if (mesh && mesh->triangles.empty() && !settings.stop.stop_requested())
    return refused(model, "the solid is empty");
  return mesh;
}

Result<SolidMesh> solid_or_nothing_of(const Model& model, const Workers& workers,
                                      BoundaryStats* stats, BoundarySettings settings) {
  if (model.drawing)
    return refused(model, "the model is flat, not a solid; .svg and .dxf hold what is flat");
  const Result<Scene> scene = lower(model, &workers);
  if (!scene) return scene.error();
  const std::vector<Appearance> looks = appearances(model);
  const std::vector<uint32_t> paints = paints_of(looks);
  settings.paints = paints;
  Result<SolidMesh> mesh = evaluate_solid(*scene, workers, stats, settings);
  if (!mesh) {
    return mesh.error().kind == ErrorKind::kInput ? refused(model, mesh.error().message)
                                                  : mesh.error();
  }
  for (SolidMesh::Face& face : mesh->faces) face.color = looks[face.owner].color;
  return mesh;
}

Result<std::vector<std::vector<Vec2>>> drawing_of(const Model& model) {
  if (!model.drawing) return refused(model, "the model is not flat, so it has no outlines");
  if (model.drawing->outlines.empty()) return refused(model, "the drawing is empty");
  return model.drawing->outlines;
}

}  // namespace whittle

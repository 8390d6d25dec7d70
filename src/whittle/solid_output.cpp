#include "whittle/solid_output.h"

#include <algorithm>
#include <cctype>

#include "lower/lower.h"

namespace whittle {
namespace {

constexpr Choice<SolidFormat> kFormats[] = {{"stl", SolidFormat::kStl},
                                            {"binstl", SolidFormat::kStl},
                                            {"asciistl", SolidFormat::kAsciiStl},
                                            {"off", SolidFormat::kOff},
                                            {"obj", SolidFormat::kObj}};

}  // namespace

Choices<SolidFormat> solid_format_choices() {
  return kFormats;
}

std::optional<SolidFormat> solid_format_of(std::string_view path) {
  const size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  std::string ending(path.substr(dot + 1));
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == "stl") return SolidFormat::kStl;
  if (ending == "off") return SolidFormat::kOff;
  if (ending == "obj") return SolidFormat::kObj;
  return std::nullopt;
}

Result<SolidMesh> solid_of(const Model& model, int threads, BoundaryStats* stats) {
  const auto refused = [&](const std::string& why) {
    return Error{ErrorKind::kInput, model.file + ": error: " + why};
  };
  if (model.drawing) return refused("is flat; these files hold solids");
  const Workers workers(threads);
  const Result<Scene> scene = lower(model, &workers);
  if (!scene) return scene.error();
  Result<SolidMesh> mesh = evaluate_solid(*scene, workers, stats);
  if (!mesh)
    return mesh.error().kind == ErrorKind::kInput ? refused(mesh.error().message) : mesh.error();
  if (mesh->triangles.empty()) return refused("the solid is empty");
  return mesh;
}

}  // namespace whittle

// By how much two solids differ, as a solid of its own.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "boundary/evaluate_solid.h"
#include "boundary/write_solid.h"
#include "lower/lower.h"
#include "support/mesh_checks.h"
#include "support/read_text.h"

namespace whittle {

/// What a file that is called `name` and holds `bytes` says.
inline Model imported(const std::string& name, const std::string& bytes) {
  ReadOptions options;
  options.named_files = [&](const std::string&) -> Result<std::optional<std::string>> {
    return std::optional(bytes);
  };
  return model_of("import(\"" + name + "\");", "imported.csg", options);
}

/// The boundary of a model's solid, which must have one. Without triangles if it is empty.
inline SolidMesh evaluated(const Model& model) {
  const Result<Scene> scene = lower(model);
  EXPECT_TRUE(scene);
  if (!scene) return {};
  Result<SolidMesh> mesh = evaluate_solid(*scene, Workers(2));
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? *std::move(mesh) : SolidMesh();
}

/// The volume of what is in one of two solids and not in the other.
inline double symmetric_difference(const SolidMesh& a, const SolidMesh& b) {
  const Workers workers(2);
  const auto off = [&](const SolidMesh& mesh) {
    return write_solid(mesh, SolidFormat::kOff, workers)->bytes;
  };
  ReadOptions options;
  options.named_files = [&](const std::string& name) -> Result<std::optional<std::string>> {
    return std::optional(off(name == "a.off" ? a : b));
  };
  double sum = 0;
  for (const char* text : {"difference() { import(\"a.off\"); import(\"b.off\"); }",
                           "difference() { import(\"b.off\"); import(\"a.off\"); }"})
    sum += volume(evaluated(model_of(text, "rest.csg", options)));
  return sum;
}

/// The largest coordinate.
inline double reach_of(const SolidMesh& mesh) {
  double reach = 0;
  for (const Vec3& corner : mesh.corners) reach = std::max(reach, max_component(abs(corner)));
  return reach;
}

}  // namespace whittle

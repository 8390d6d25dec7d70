// A solid's file, read again, looks as the solid that was written, to the oracle's eye: scenes of
// coincident faces, random trees and the examples, as OFF (doubles) and as STL (32-bit floats).
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "agreement/cpu_subject.h"
#include "boundary/evaluate_solid.h"
#include "boundary/write_solid.h"
#include "coincident/scenes.h"
#include "host/read_file.h"
#include "lower/lower.h"
#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

/// What a file that is called `name` and holds `bytes` says.
Model imported(const std::string& name, const std::string& bytes) {
  ReadOptions options;
  options.named_files = [&](const std::string&) -> Result<std::optional<std::string>> {
    return std::optional(bytes);
  };
  return model_of("import(\"" + name + "\");", "imported.csg", options);
}

/// Pixels that hit. None if the model has no mesh: it is empty, or without end.
int compare_with_its_files(const Model& model) {
  const Result<Scene> scene = lower(model);
  if (!scene || !scene->bounded) return 0;
  const Workers workers(2);
  const Result<SolidMesh> mesh = evaluate_solid(*scene, workers);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh || mesh->triangles.empty()) return 0;
  const auto oracle = make_oracle_tracer(model);
  const auto any_id = [](const Ray&, const Hit&, uint32_t) { return true; };
  int hits = 0;
  for (const auto& [format, name] :
       {std::pair(SolidFormat::kOff, "solid.off"), std::pair(SolidFormat::kStl, "solid.stl")}) {
    SCOPED_TRACE(name);
    const Result<SolidFile> file = write_solid(*mesh, format, workers);
    EXPECT_TRUE(file);
    if (!file) return 0;
    const Model again = imported(name, file->bytes);
    CpuSubject cpu(again, {});
    for (const Camera& camera : cameras_for(model, 64, 48)) {
      const AgreementReport report = find_differences(model, *cpu.tracer, *oracle, camera, any_id);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
      hits += report.hits;
    }
  }
  return hits;
}

TEST(Reimported, ScenesWithCoincidentFacesLookAsTheyWere) {
  int hits = 0;
  for (const auto& chapter : {flush_scenes, abutting_scenes, body_scenes, curved_scenes,
                              facet_scenes, algebra_scenes, menger_scenes}) {
    for (const CoincidentScene& scene : chapter()) {
      SCOPED_TRACE(scene.name);
      hits += compare_with_its_files(facetted_model_of(scene.text));
    }
  }
  EXPECT_GT(hits, 100'000);
}

TEST(Reimported, RandomTreesLookAsTheyWere) {
  int hits = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = random_tree(seed, {.primitives = 14, .coincident = seed % 2 != 0});
    hits += compare_with_its_files(facetted_model_of(text));
  }
  EXPECT_GT(hits, 20'000);
}

TEST(Reimported, ExamplesLookAsTheyWere) {
  // The oracle asks every face, for every ray.
  constexpr size_t kMostHalfSpaces = 5000;
  int hits = 0, files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WHITTLE_EXAMPLES)) {
    if (entry.path().extension() != ".csg") continue;
    SCOPED_TRACE(entry.path().filename());
    const Result<Read> read =
        read_file(entry.path(),
                  {.reading = {.curves = Curves::kOpenscad2021}, .import_root = {}, .flatten = {}});
    ASSERT_TRUE(read);
    const Result<Scene> scene = lower(read->model);
    if (!scene || scene->half_spaces.size() > kMostHalfSpaces) continue;
    ++files;
    hits += compare_with_its_files(read->model);
  }
  EXPECT_GE(files, 10);
  EXPECT_GT(hits, 10'000);
}

}  // namespace
}  // namespace whittle

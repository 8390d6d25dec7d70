// The boundary of every scene of scenes.h, with facets, is closed, and encloses as much as that of
// its answer.
#include <gtest/gtest.h>

#include "boundary/evaluate_solid.h"
#include "coincident/scenes.h"
#include "coincident/turned.h"
#include "lower/lower.h"
#include "support/mesh_checks.h"
#include "support/read_text.h"

namespace whittle {
namespace {

bool is_curved(const std::string& text) {
  const Result<Scene> scene = lower(model_of(text));
  return !scene ||
         std::ranges::any_of(scene->half_spaces, [](const HalfSpace& h) { return !h.is_plane(); });
}

/// The volume; nothing of a solid without end. Fails if the mesh is none of a solid.
std::optional<double> closed_volume(const Model& model) {
  const Result<Scene> scene = lower(model);
  if (!scene || !scene->bounded) return std::nullopt;
  const Workers workers(2);
  BoundaryStats stats;
  const Result<SolidMesh> mesh = evaluate_solid(*scene, workers, &stats);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh) return std::nullopt;
  EXPECT_EQ(manifold_fault(*mesh), "");
  EXPECT_TRUE(stats.joins <= 1 || !scene->boundaries.empty()) << "cells disagree";
  return volume(*mesh);
}

TEST(CoincidentBoundary, IsClosedAndEnclosesTheSame) {
  size_t compared = 0;
  for (const auto& chapter : {flush_scenes, abutting_scenes, body_scenes, curved_scenes,
                              facet_scenes, algebra_scenes, tolerance_scenes, menger_scenes}) {
    for (const CoincidentScene& scene : chapter()) {
      SCOPED_TRACE(scene.name);
      const std::optional<double> its = closed_volume(facetted_model_of(scene.text));
      // Some are equal only as far as they are looked at.
      if (!its || scene.formula || scene.only_looks) continue;
      if (is_curved(scene.text) || is_curved(scene.equal)) continue;
      const std::optional<double> right = closed_volume(facetted_model_of(scene.equal));
      if (!right) continue;
      ++compared;
      EXPECT_NEAR(*its, *right, 1e-4 * *right);
    }
  }
  EXPECT_GT(compared, 50u);
}

TEST(CoincidentBoundary, IsClosedInAnotherPlace) {
  for (const auto& chapter :
       {flush_scenes, abutting_scenes, body_scenes, curved_scenes, facet_scenes, algebra_scenes}) {
    for (const CoincidentScene& scene : chapter()) {
      if (!scene.turns) continue;
      SCOPED_TRACE(scene.name);
      const Model model = facetted_model_of(scene.text);
      for (const bool mirrored : {false, true})
        closed_volume(turned(model, turn_of(model, mirrored)));
    }
  }
}

}  // namespace
}  // namespace whittle

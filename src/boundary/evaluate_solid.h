// From a scene of planes to the boundary of its solid, exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>

#include "base/result.h"
#include "base/workers.h"
#include "boundary/solid_mesh.h"
#include "lower/scene.h"

namespace whittle {

struct BoundaryStats {
  size_t leaves = 0, contacts = 0, pieces = 0, outline_edges = 0, shared_edges = 0, collapsed = 0;
  bool asked_all_contacts = false;
  /// How often pieces were joined. More than once if cells disagreed, which they may by less than
  /// the boundaries' slack.
  size_t joins = 0;
  size_t whole_planes = 0;  ///< whose faces were decided one by one, without cells
  double planes_ms = 0, group_ms = 0, faces_ms = 0;
  double cells_ms = 0, cut_ms = 0, join_ms = 0, fill_ms = 0;
};

struct BoundarySettings {
  /// By id of body; empty: all are 0. Faces of different paints are apart though they lie in one
  /// plane, and each is its own body's.
  std::span<const uint32_t> paints{};
  /// Once a stop is requested, evaluate_solid() returns soon, and its mesh is of no use.
  std::stop_token stop{};
  /// Told, from any thread, the share that is done, 0 to 1.
  std::function<void(double share)> progress{};
  size_t cell_memory = size_t(1) << 30;  ///< as SubdivideSettings::memory
  /// Pairs of half-spaces that meet in a leaf, of all leaves together: about what cutting takes.
  uint64_t pairs = UINT64_MAX;
  size_t pieces = SIZE_MAX;  ///< convex ones that faces are cut into
  /// Faces that can be decided one by one are; else all are cut in cells. The surface is the same,
  /// though not its triangles.
  bool whole_faces = true;
};

/// The boundary of the scene's solid; nothing of an empty one. Its corners are right to a few units
/// of the last place, or where edges no longer than 10^-12 of the region were drawn together, by as
/// much. The same whatever the number of threads. A kInput error if the solid has no end, or curved
/// surfaces, or passes a limit.
Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers,
                                 BoundaryStats* stats = nullptr,
                                 const BoundarySettings& settings = {});

}  // namespace whittle

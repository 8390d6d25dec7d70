// From a scene of planes to the boundary of its solid, exactly.
#pragma once

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
  double cells_ms = 0, cut_ms = 0, join_ms = 0, fill_ms = 0;
};

/// The boundary of the scene's solid; nothing of an empty one. Its corners are right to a few units
/// of the last place, or where edges no longer than 10^-12 of the region were drawn together, by as
/// much. The same whatever the number of threads. A kInput error if the solid has no end, or curved
/// surfaces.
Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers,
                                 BoundaryStats* stats = nullptr);

}  // namespace whittle

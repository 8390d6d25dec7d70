// From a scene of planes to the boundary of its solid, exactly.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "base/workers.h"
#include "boundary/solid_mesh.h"
#include "lower/scene.h"

namespace whittle {

struct BoundaryStats {
  size_t leaves = 0, contacts = 0, pieces = 0, outline_edges = 0, shared_edges = 0, collapsed = 0;
  bool asked_all_contacts = false;  ///< cells may disagree, by less than the boundaries' slack
  double cells_ms = 0, cut_ms = 0, join_ms = 0, fill_ms = 0;
};

/// What a boundary may take.
struct BoundaryLimits {
  size_t cell_memory = size_t(1) << 30;  ///< as SubdivideSettings::memory
  /// Pairs of half-spaces that meet in a leaf, of all leaves together: about what cutting takes.
  uint64_t pairs = UINT64_MAX;
  size_t pieces = SIZE_MAX;  ///< that the boundary is made of before it is joined
};

/// The boundary of the scene's solid; nothing of an empty one. Its corners are right to a few units
/// of the last place, or where edges no longer than 10^-12 of the region were drawn together, by as
/// much. The same whatever the number of threads. A kInput error if the solid has no end, or curved
/// surfaces, or passes a limit.
Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers,
                                 BoundaryStats* stats = nullptr, const BoundaryLimits& limits = {});

}  // namespace whittle

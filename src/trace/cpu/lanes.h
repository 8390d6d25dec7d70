// Rays in vector lanes: as many rays at once as a vector holds doubles, walked through the cells
// together. The instruction set is chosen at run time; every one gives the same bits.
#pragma once

#include <span>
#include <vector>

#include "subdivide/refine.h"
#include "trace/cpu/cpu.h"
#include "trace/cpu/solve.h"

namespace whittle {

/// What one thread needs besides the scene and the cells.
struct LaneScratch {
  LaneScratch(const Scene& scene, const CellTree& cells) : refiner(cells), solver(scene) {}

  RefinerLease refiner;
  LeafSolver solver;
  std::vector<double> along;         ///< per literal of a leaf: four vectors, f along the rays
  std::vector<LaneSigns> signs;      ///< per literal
  std::vector<LiteralOnRay> on_ray;  ///< per literal, of one ray
  TraceStats stats;
};

/// The hits of the rays through `positions`, which had better be close to one another, in order.
/// hits.size() == positions.size().
void trace_lanes(const Scene& scene, const CellTree& cells, const Camera& camera,
                 std::span<const PixelPosition> positions, std::span<Hit> hits,
                 LaneScratch& scratch);

}  // namespace whittle

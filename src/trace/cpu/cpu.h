// The CPU backend: walks the cells front to back along every ray and solves the leaves it meets,
// in double precision, on all threads.
//
// Based on: the paper, section 3 (ray-tracing inside a cell, clipped to it). What we changed: no
// cell is rasterised, rays walk the tree; a leaf may hold any number of half-spaces; a ray carries
// into a cell whether it is in the solid, so a surface that lies on a cell's side is found once and
// never lost.
#pragma once

#include <memory>

#include "subdivide/cells.h"
#include "trace/tracer.h"

namespace whittle {

/// Work done since the tracer was made.
struct TraceStats {
  uint64_t rays = 0;
  uint64_t cells = 0;          ///< cells visited, nodes and leaves; where rays walk together, once
                               ///< for each that may meet them
  uint64_t leaves = 0;         ///< leaves solved
  uint64_t literals = 0;       ///< half-spaces intersected
  uint64_t disagreements = 0;  ///< neighbouring cells that disagree on a point between them: none
};

/// `scene` and `cells` must outlive the tracer. `threads` 0 means all.
class CpuTracer : public Tracer {
 public:
  virtual TraceStats stats() const = 0;

  /// As render(), and remembers for every ray that hits something the leaf in which it does.
  virtual Frame record(const Camera& camera) = 0;
  /// The same frame from what record() kept of the same camera: no ray has to look for its leaf.
  /// No walk through the cells, however good, can make render() faster than this.
  virtual Frame replay(const Camera& camera) = 0;
};
std::unique_ptr<CpuTracer> make_cpu_tracer(const Scene& scene, const CellTree& cells,
                                           int threads = 0);

}  // namespace whittle

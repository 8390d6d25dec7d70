// Lines that are cut into parts on all threads, with one result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/workers.h"
#include "lines/line_limits.h"
#include "lines/segment_grid.h"

namespace whittle {

/// What add(i, visited, out) appends to `out` for every line i < `lines`, in the order of the
/// lines. `visited` is a thread's own, for a grid of `segments`. Fails when the budget is spent,
/// which add() charges before it takes memory.
template <class Part, class Add>
Result<std::vector<Part>> gather_parts(size_t lines, size_t segments, const Workers& workers,
                                       const LineBudget& budget, const Add& add) {
  constexpr size_t kChunk = 256;
  std::vector<std::vector<Part>> chunks((lines + kChunk - 1) / kChunk);
  PerWorker<SegmentGrid::Visited> visited(workers);
  workers.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t worker) {
    SegmentGrid::Visited& own = visited.of(worker, segments);
    for (size_t i = first * kChunk; i < std::min(lines, last * kChunk); ++i) {
      if (budget.is_spent()) return;
      add(i, own, chunks[i / kChunk]);
    }
  });
  if (budget.is_spent()) return budget.error();
  size_t count = 0;
  for (const std::vector<Part>& chunk : chunks) count += chunk.size();
  std::vector<Part> parts;
  parts.reserve(count);
  for (const std::vector<Part>& chunk : chunks)
    parts.insert(parts.end(), chunk.begin(), chunk.end());
  return parts;
}

}  // namespace whittle

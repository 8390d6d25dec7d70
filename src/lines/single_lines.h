// Lines of a drawing that lie on one another are drawn once.
#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/workers.h"
#include "lines/line_drawing.h"
#include "lines/line_limits.h"
#include "lines/segment_grid.h"

namespace whittle {

struct KindLine {
  Segment segment;
  LineKind kind = LineKind::kEdge;
};

/// What is left of each line where those before it in the row that lie on it, nowhere farther from
/// it than `apart`, have been taken away. In the same order; what is no longer than `shortest` is
/// left out. A kMachine error for what passes the limits.
Result<std::vector<KindLine>> single_lines(std::span<const KindLine> lines, double apart,
                                           double shortest, const Workers& workers,
                                           const LineLimits& limits = {});

}  // namespace whittle

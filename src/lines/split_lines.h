// Drawn lines are cut where what hides them may change.
#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/workers.h"
#include "lines/line_limits.h"
#include "lines/projection.h"

namespace whittle {

/// A part of a drawn line that is seen as a whole or hidden as a whole.
struct LinePart {
  uint32_t line = 0;
  double from = 0, to = 1;
};

/// Cuts every line where one of the covering lines runs before it in the drawing. Parts are in the
/// order of their lines, and of each line from its start. `length`: parts are no shorter, in units
/// of the drawing, unless the line is. A kMachine error for what passes the limits.
Result<std::vector<LinePart>> split_lines(std::span<const DrawnLine> lines,
                                          std::span<const DrawnLine> covering,
                                          const ViewProjection& projection, double length,
                                          const Workers& workers, const LineLimits& limits = {});

}  // namespace whittle

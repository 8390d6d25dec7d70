// Which parts of a drawing's lines nothing is before.
#pragma once

#include <span>
#include <vector>

#include "lines/solid_edges.h"
#include "lines/split_lines.h"
#include "trace/tracer.h"

namespace whittle {

/// By part: whether it is seen. The eye's ray to a place right beside the middle of the part, on a
/// face that looks to the eye, must meet nothing before that place. `tracer` is of the same solid
/// as the edges. `progress` is told the share that is done.
std::vector<bool> visible_parts(std::span<const LinePart> parts, std::span<const DrawnLine> lines,
                                std::span<const SolidEdge> edges, const ViewProjection& projection,
                                Tracer& tracer, const Progress& progress);

}  // namespace whittle

// Edges between facets that the true surfaces do not have.
#pragma once

#include <span>
#include <vector>

#include "lines/solid_edges.h"
#include "lines/split_lines.h"
#include "trace/tracer.h"

namespace whittle {

/// By part: whether the true solid is smooth there, so that there is nothing to draw. Where two
/// curves go over into one another, or are one, their facets need not fit: a ball at the end of a
/// rod of its width leaves a narrow step. Asked are edges that may be made of facets, and the
/// answer is what two rays see beside them on both sides. `tracer`: of the solid with its true
/// curves.
std::vector<bool> smooth_parts(std::span<const LinePart> parts, std::span<const DrawnLine> lines,
                               std::span<const SolidEdge> edges, const std::vector<bool>& visible,
                               const Projection& projection, Tracer& tracer);

}  // namespace whittle

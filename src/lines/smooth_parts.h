// Edges between facets that one does not want to see.
#pragma once

#include <span>
#include <vector>

#include "lines/solid_edges.h"
#include "lines/split_lines.h"
#include "trace/tracer.h"

namespace whittle {

/// Marks the parts, of edges with that doubt, where the solid is smooth: what two rays see, on one
/// side of it and on the other, are places of one surface.
///
/// Doubt::kMade: `tracer` is of the solid with its true curves. Where two of them go over into one
/// another, or are one, their facets need not fit: a ball at the end of a rod of its width leaves a
/// narrow step.
///
/// Doubt::kFold: `tracer` is of the solid with facets. Along a twisted surface every other triangle
/// looks a little away from an eye that looks along it.
void mark_smooth_parts(Doubt doubt, std::span<const LinePart> parts,
                       std::span<const DrawnLine> lines, std::span<const SolidEdge> edges,
                       const std::vector<bool>& visible, const ViewProjection& projection,
                       Tracer& tracer, std::vector<bool>& smooth);

}  // namespace whittle

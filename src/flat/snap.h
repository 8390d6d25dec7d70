// Makes the outlines that come from Clipper free of crossings for certain.
#pragma once

#include <clipper.hpp>
#include <functional>

namespace whittle {

/// Clipper rounds where edges cross, and so edges that should touch a corner may pass it on the
/// wrong side by a step. Here corners that are nearer than that become one, and edges that pass a
/// corner that near go through it. What comes out touches in corners only, and moving any corner
/// within its square of the grid makes no crossing. Edges that then lie on one another go.
///
/// (After Hobby, Practical segment intersection with finite precision output, Computational
/// Geometry 13, 1999.)
///
/// `is_fixed` tells the corners that others move to, not the other way round.
ClipperLib::Paths snapped(ClipperLib::Paths paths,
                          const std::function<bool(const ClipperLib::IntPoint&)>& is_fixed);

}  // namespace whittle

// The region that outlines without crossings enclose.
#pragma once

#include <clipper.hpp>

namespace whittle {

/// Outlines of where the winding number of `paths` is not 0. They must not cross, but their edges
/// may lie on one another: so it is with what rounding has made of slivers, and now and then with
/// what Clipper makes of edges that come in threes. Paths that are outlines of a region already
/// stay as they are.
ClipperLib::Paths regularized(ClipperLib::Paths paths);

}  // namespace whittle

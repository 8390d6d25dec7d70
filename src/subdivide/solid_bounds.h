// The tight box of a solid: what is left after subtractions, not what the tree's boxes allow.
//
// A branch and bound in each of the six directions. Of the cells that may hold the farthest point
// the one that reaches farthest is looked at first; what lies behind the best point known is cut
// off. In a cell with few half-spaces the formula is a union of few polytopes (curved surfaces
// count by their tangent planes, moved by as much as they bend in the cell), and a linear program
// says how far each of them reaches.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lower/scene.h"

namespace whittle {

/// How exact: a side is wrong by at most this share of the box's longest edge.
inline constexpr double kBoundsAccuracy = 1e-6;

struct SolidBounds {
  Box box;              ///< world; empty if the solid is
  bool bounded = true;  ///< false: the solid reaches the sides of the scene's region
  /// False if work was cut short: a side may then lie farther out than the solid reaches.
  bool exact = true;
};

/// Cells that the search in one direction looks at before it gives up. Corners and flat faces take
/// tens, rims of curved surfaces thousands.
inline constexpr size_t kBoundsCells = size_t(1) << 14;

/// The box of the scene's solid. The work is bounded: a few passes over the formula and
/// `most_cells` cells a direction. Where that does not do, the side is the farthest that is still
/// possible: the box is never too small by more than its accuracy. `threads` 0: all; the result
/// does not depend on it.
SolidBounds solid_bounds(const Scene& scene, int threads, size_t most_cells = kBoundsCells);

/// How exact: the reach is wrong by at most this share of the box's longest edge, times the
/// direction's length.
inline constexpr double kReachAccuracy = 1e-4;

/// How far the scene's solid reaches in each of some directions: its largest direction . p.
/// Precondition: `box` is finite and holds the solid; world. An empty one gives -infinity. Bounded
/// and reproducible as solid_bounds().
std::vector<double> solid_reach(const Scene& scene, const Box& box,
                                std::span<const Vec3> directions, int threads,
                                size_t most_cells = kBoundsCells);

}  // namespace whittle

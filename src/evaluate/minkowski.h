// Minkowski sums of solids.
#pragma once

#include <vector>

#include "evaluate/budget.h"
#include "evaluate/solid_parts.h"
#include "model/model.h"

namespace whittle {

/// The Minkowski sum of all operands, as shapes whose union it is; an operand without volume
/// does not count. Sums distribute over the parts. Of two of them, A and B:
///
/// - both convex: the hull of the sums of their corners;
/// - B convex: A moved by a point of B, and for each facet T of A the hull of T + B. (What p - B, a
///   connected set, does not cut A's boundary is inside of A with each of its points.)
/// - else: A moved by a point of each shell of B, B moved by a point of each shell of A, and for
///   all facets S of A and T of B the hull of S + T.
///
/// Spends what it computes with, and the facets of what comes of it.
std::vector<Shape> minkowski_sum(std::vector<SolidPart> parts, int threads, Budget& budget);

}  // namespace whittle

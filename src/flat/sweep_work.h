// How long Clipper would take, before it is asked.
#pragma once

#include <cstdint>
#include <span>

#include "flat/polygons.h"

namespace whittle {

/// What Clipper's sweep has to do for all contours at once, in steps of about 20 ns: one for each
/// pair of edges that some level line meets both of, many more for each pair that crosses. Exact
/// where there are few pairs, else from two million of them, so that few crossings among many edges
/// may go unseen. The same for the same contours.
uint64_t estimate_sweep_work(std::span<const Contour> contours);

/// Ten seconds. No drawing comes near it.
inline constexpr uint64_t kMostSweepWork = 500'000'000;

}  // namespace whittle

// How long Clipper would take, estimated before it is called.
#pragma once

#include <cstdint>
#include <span>

#include "flat/polygons.h"

namespace whittle {

/// What Clipper's sweep has to do for all contours at once, in steps of about 20 ns: one for each
/// pair of edges that some level line meets both of, many more for each pair that crosses. Exact
/// where there are few edges, else from a few pairs for each, two million at most, so that few
/// crossings among many edges may go unseen. The same for the same contours.
uint64_t estimate_sweep_work(std::span<const Contour> contours);

/// About five seconds. No real drawing comes near it.
inline constexpr uint64_t kMostSweepWork = 250'000'000;

/// What is said of a file that would take more.
inline constexpr char kTooTangled[] = "it has too many lines across one another";

}  // namespace whittle

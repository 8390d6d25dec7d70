// Ambient occlusion: how much of its surroundings a point of the surface sees.
//
// Rays leave each hit in directions spread over the half-sphere as the cosine. One that meets
// something at distance t hides (1 - (t / reach)^2)^2 of what lies there. Each pixel sends few of
// them, but others than its neighbours; pixels of a block of 8 x 8 together look everywhere. So the
// mean over such a block, of the pixels that no edge parts from the one in the middle, is an
// estimate by 64 times as many rays, without noise; and the mean over 8 x 8 of those has no steps.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "base/workers.h"
#include "trace/camera.h"
#include "trace/frame.h"
#include "trace/tracer.h"

namespace whittle {

inline constexpr int kMostOcclusionRays = 16;
inline constexpr size_t kMostOcclusionStep = 4;

struct OcclusionSettings {
  double reach = 0;  ///< how far hits see, model units; infinity: without end
  int rays = 1;      ///< of a pixel that sends any, a power of four to kMostOcclusionRays
  /// Pixels from one that sends rays to the next, both ways, a power of two to kMostOcclusionStep.
  /// The mean is of so many times as wide a block. Where a face is too narrow for that, pixels
  /// between them send rays, too, or all.
  size_t step = 1;
};

/// Rays that leave a surface start this share of the way to it in front of it, as shadows do:
/// docs/numerics.md.
inline constexpr double kLeaveTolerance = 1.0 / (1 << 18);

/// How much of what lies in its direction a ray's hit hides.
double hidden_share(const Hit& hit, double reach);

/// For each pixel the share of its surroundings that it sees, 0 to 1; 1 where nothing is hit. The
/// same on any number of threads. Once a stop is requested it returns soon, and the result is of no
/// use.
std::vector<float> openness(Tracer& tracer, const Camera& camera, const Frame& frame,
                            const OcclusionSettings& settings, const Workers& workers,
                            const std::stop_token& stop = {});

}  // namespace whittle

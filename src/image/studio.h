// Style studio: a picture like the photograph of a product, from facts and nothing else. Lights are
// those of shade_lanes.cpp; what rays add: ambient occlusion (occlusion.h), a shadow on the ground
// (ground.h) and lines at edges (feature_lines.h). Why: docs/decisions/0047-studio.md.
#pragma once

#include <span>
#include <stop_token>

#include "image/shade.h"
#include "image/veil.h"
#include "trace/tracer.h"

namespace whittle {

/// Ambient occlusion reaches this share of the solid's diagonal.
inline constexpr double kOcclusionReach = 0.25;

/// The picture of a frame. Pixels at edges (edge_mask), with shadows at theirs too, are the mean of
/// n * n samples that are spread over two pixels' width as a tent. n <= 1: one sample, no lines.
/// Without background the ground's shadow is a translucent black. Deterministic. Once a stop is
/// requested it returns soon, and the picture is of no use. Precondition: the style is kStudio.
/// With a veil, tracer and frame are those of what is opaque: what is see-through is laid over
/// that, with lines at its edges; it hides no light, but darkens the ground as much as its colour
/// hides.
Picture shade_studio(Tracer& tracer, const Camera& camera, const Frame& frame,
                     std::span<const Appearance> appearances, const ShadeSettings& settings, int n,
                     const Workers& workers, const std::stop_token& stop = {},
                     Veil* veil = nullptr);

}  // namespace whittle

// Antialiasing where it is needed: many rays only through pixels whose facts differ from a
// neighbour's.
#pragma once

#include <span>
#include <stop_token>

#include "image/shade.h"
#include "image/veil.h"
#include "trace/tracer.h"

namespace whittle {

/// shade(), but pixels at edges (edge_mask) are the mean of n * n samples on a regular grid. Linear
/// light is averaged in the plain style; the others define display values and know no light, so
/// there those are averaged, as OpenGL's multisampling does. Without background the colour is the
/// mean of the samples that hit, and alpha their share. With shadows, their edges are edges too.
/// Deterministic; n <= 1 is shade(). Once a stop is requested it returns soon, and the picture is
/// of no use. With a veil, tracer and frame are those of what is opaque, and what is see-through is
/// laid over that. Precondition: the style is not kStudio, which shade_studio() draws.
Picture shade_antialiased(Tracer& tracer, const Camera& camera, const Frame& frame,
                          std::span<const Appearance> appearances, const ShadeSettings& settings,
                          int n, const Workers& workers, const std::stop_token& stop = {},
                          Veil* veil = nullptr);

}  // namespace whittle

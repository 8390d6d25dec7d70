// Antialiasing where it is needed: many rays only through pixels whose facts differ from a
// neighbour's.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "image/shade.h"
#include "trace/tracer.h"

namespace whittle {

/// The pixels at edges, one byte each (1: edge). A pixel is at an edge if one of its eight
/// neighbours has another id, or a normal more than 8 degrees away, or a distance that neither
/// pixel's tangent plane predicts to within two pixels' width.
std::vector<uint8_t> edge_mask(const Frame& frame, const Camera& camera, const Workers& workers);

/// shade(), but pixels at edges are the mean of n * n samples on a regular grid. Linear light is
/// averaged in the studio style; the others define display values and know no light, so there those
/// are averaged, as OpenGL's multisampling does. Without background the colour is the mean of the
/// samples that hit, and alpha their share. With shadows, their edges are edges too. Deterministic;
/// n <= 1 is shade(). Once a stop is requested it returns soon, and the picture is of no use.
Picture shade_antialiased(Tracer& tracer, const Camera& camera, const Frame& frame,
                          std::span<const Appearance> appearances, const ShadeSettings& settings,
                          int n, const Workers& workers, const std::stop_token& stop = {});

}  // namespace whittle

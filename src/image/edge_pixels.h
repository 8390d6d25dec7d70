// Which pixels are at edges: where the facts of neighbours differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workers.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

/// The cosine of 8 degrees: pixels whose normals are farther apart are at an edge.
inline constexpr float kCosEdge = 0.99026806874157f;

/// For each pixel, which of its later neighbours differ from it (LaterNeighbour). Two pixels differ
/// if they have another id, or normals whose cosine is less, or a distance that neither's tangent
/// plane predicts to within two pixels' width.
std::vector<uint8_t> later_differences(const Frame& frame, const Camera& camera,
                                       const Workers& workers, float least_cosine);

/// The pixels of which one of the eight neighbours differs, one byte each (1: edge).
std::vector<uint8_t> edge_mask(const std::vector<uint8_t>& differences, size_t width,
                               const Workers& workers);

/// The same of a frame, with kCosEdge.
std::vector<uint8_t> edge_mask(const Frame& frame, const Camera& camera, const Workers& workers);

/// Where the mask is set, a block of 4 x 4 pixels after the other: rays that are close to one
/// another are traced for less.
std::vector<size_t> places_in_blocks(const std::vector<uint8_t>& mask, size_t width);

}  // namespace whittle

// Flat facets as few convex polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "shape/triangle_mesh.h"

namespace whittle {

/// Convex polygons that together are the triangles: neighbours of one facet are joined across their
/// common edges, the longest first, as long as what comes of them is convex (Hertel and Mehlhorn
/// 1983: at most four times as many as need be). None has more than kMostPieceCorners corners.
std::vector<std::vector<uint32_t>> convex_pieces(std::span<const Vec3> points,
                                                 std::span<const TriangleMesh::Triangle> triangles);
inline constexpr size_t kMostPieceCorners = 256;

}  // namespace whittle

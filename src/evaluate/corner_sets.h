// Solids as the corners of their hulls: what hull() and minkowski() compute with.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "evaluate/budget.h"
#include "flat/polygons.h"
#include "model/document.h"
#include "model/model.h"

namespace whittle {

/// A part of an operand.
struct CornerSet {
  std::vector<Vec3> points;  ///< their hull holds the part
  bool is_convex = false;    ///< and is the part
  uint32_t operand = 0;      ///< of the operation that holds it, from 0
};

/// Of a bounded shape. Meshes are looked at whether they are convex only if `wants_convex`.
CornerSet corners_of(const Shape& shape, bool wants_convex, Budget& budget);

/// Of straight extrusions. If `wants_convex`, what is not convex is cut into parts that are.
std::vector<CornerSet> extruded_corners(const Polygons& polygons, const LinearExtrude& how,
                                        bool wants_convex, Budget& budget);

/// The Minkowski sum of all operands, as convex parts; an operand without parts does not count.
/// None if a part is not convex, or a sum is flat.
std::optional<std::vector<Polyhedron>> minkowski_parts(std::vector<CornerSet> sets, Budget& budget);

}  // namespace whittle

// Solids as parts of operands: what hull() and minkowski() compute with.
#pragma once

#include <cstdint>
#include <vector>

#include "base/affine.h"
#include "base/vec.h"
#include "evaluate/budget.h"
#include "flat/polygons.h"
#include "model/document.h"
#include "model/model.h"

namespace whittle {

/// A part of an operand, which is the union of its parts.
struct SolidPart {
  std::vector<Vec3> points;  ///< their hull is the part, or holds it
  /// Its closed surface, if it is not the hull; into `points`. Facets are planes, by number alone.
  std::vector<TriangleMesh::Triangle> triangles = {};
  uint32_t operand = 0;  ///< of the operation that holds it, from 0

  bool is_convex() const { return triangles.empty(); }
};

/// Of a bounded shape with flat faces; of another, or an empty one, without points. A hull needs
/// the points alone; if `wants_surface`, what is not convex has its surface.
SolidPart part_of(const Shape& shape, bool wants_surface, Budget& budget);

/// Of the boundary of a solid (boundary/closed_mesh.h). What hangs together is one part, unless
/// there are hollows.
std::vector<SolidPart> parts_of(const TriangleMesh& boundary, bool wants_surface);

/// Of straight extrusions. If `wants_surface`, what is not convex is cut into parts that are.
std::vector<SolidPart> extruded_parts(const Polygons& polygons, const LinearExtrude& how,
                                      bool wants_surface, Budget& budget);

/// Moves it; mirrors turn its triangles.
void transform(const Affine& map, SolidPart& part);

/// The numbers of the shells of a surface, by point: what hangs together by triangles. Points
/// without triangles have none, which is the number of shells.
struct Shells {
  std::vector<uint32_t> of_point;
  uint32_t count = 0;
};
Shells shells_of(const SolidPart& part);

}  // namespace whittle

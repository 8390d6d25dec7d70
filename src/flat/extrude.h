// Extrusions of polygons as triangle meshes, with OpenSCAD's slices and facets.
#pragma once

#include "flat/polygons.h"
#include "model/document.h"
#include "model/triangle_mesh.h"

namespace whittle {

/// linear_extrude of polygons, as OpenSCAD's GeometryEvaluator makes it: slices for twist and
/// unequal scale, quads split along the shorter diagonal, a scale of 0 an apex or an edge. Empty if
/// the height is not positive. Coplanar triangles share a facet by construction, where they are
/// coplanar by construction.
TriangleMesh linear_extrude(const Polygons& polygons, const LinearExtrude& how);

/// rotate_extrude with `facets` steps for a full turn. Precondition: all points are on one side of
/// x = 0 (see crosses_axis).
TriangleMesh rotate_extrude(const Polygons& polygons, const RotateExtrude& how, int facets);

/// Whether there are points on both sides of x = 0, which OpenSCAD refuses to revolve.
bool crosses_axis(const Polygons& polygons);

}  // namespace whittle

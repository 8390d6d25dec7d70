// Extrusions of polygons as shapes.
#pragma once

#include <optional>

#include "evaluate/budget.h"
#include "flat/polygons.h"
#include "model/document.h"
#include "model/model.h"

namespace whittle {

/// The prism over a convex outline (counter-clockwise) between two heights.
Polyhedron prism(const Contour& outline, double z0, double z1);

/// The straight extrusion of polygons from z = 0 to `height`; empty if they are. Convex outlines of
/// at most kMostPrismSides become prisms, others meshes. Spends its facets.
Shape straight_extrusion(const Polygons& polygons, double height, Budget& budget);
inline constexpr size_t kMostPrismSides = 100;

/// True if all slices of the extrusion are the same, so that it commutes with Booleans and maps of
/// the plane.
bool is_straight(const LinearExtrude& how);

/// True if it is empty whatever is extruded.
bool is_flat_extrusion(const LinearExtrude& how);

/// From the straight extrusion between 0 and the height to where the statement puts it.
Affine placement(const LinearExtrude& how);

/// An extrusion with twist or scale, as OpenSCAD makes it. Spends its facets.
Shape sliced_extrusion(const Polygons& polygons, const LinearExtrude& how, Budget& budget);

/// The revolution of polygons in so many steps a turn. Spends its facets.
Shape faceted_revolution(const Polygons& polygons, const RotateExtrude& how, int facets,
                         Budget& budget);

/// A closed mesh as a shape: a polyhedron, if it is convex and has few faces. Spends its facets.
Shape shape_of(TriangleMesh mesh, Budget& budget);

}  // namespace whittle

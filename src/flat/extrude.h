// Extrusions of polygons as triangle meshes, with OpenSCAD's slices and facets.
#pragma once

#include "flat/polygons.h"
#include "model/document.h"
#include "shape/triangle_mesh.h"

namespace whittle {

// The meshes are closed edge by edge for all contours, also for such as cross. Triangles that are
// coplanar by construction share a facet: those of a cap, those of a planar side, and sides whose
// edges follow one another without a bend. Other facets that are equal to the last digit are one
// too. At most half a million sides are made: where slices or steps would make more, they are
// fewer.

/// linear_extrude of polygons: slices for twist and unequal scale, sides split along the shorter
/// diagonal, a scale of 0 an apex or an edge; a negative scale counts as 0. Empty if the
/// extrusion does not go up, or something is not finite.
///
/// Without `segments`, outlines of twisted and unequally scaled extrusions are divided as
/// OpenSCAD's development version does it; with `segments` of 0 they are left alone, and the mesh
/// is, triangle by triangle, that of OpenSCAD 2021.01. (Slices that lie in a plane are the
/// exception: extrusions without twist and with one scale have one.)
///
/// A top that is an edge is closed by triangles without area.
TriangleMesh linear_extrude(const Polygons& polygons, const LinearExtrude& how);

/// rotate_extrude with `facets` steps for a full turn (3 at least), max(1, ceil(facets * |angle| /
/// 360)) for a part of it; rings stand at start_degrees + j * angle / steps. 360 degrees or more,
/// either way, are one full turn; 0, or what is not finite, is empty. Precondition: all points are
/// on one side of x = 0 (see crosses_axis).
TriangleMesh rotate_extrude(const Polygons& polygons, const RotateExtrude& how, int facets);

/// Whether there are points on both sides of x = 0, which OpenSCAD refuses to revolve.
bool crosses_axis(const Polygons& polygons);

}  // namespace whittle

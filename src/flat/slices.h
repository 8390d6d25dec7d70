// How finely OpenSCAD cuts a twisted or scaled extrusion. The facts are OpenSCAD's
// (CurveDiscretizer, linear_extrude.cc), re-described.
#pragma once

#include "flat/polygons.h"
#include "model/document.h"

namespace whittle {

/// Whether sides are not planar: there is a twist, or x and y are scaled unequally.
bool is_curved(const LinearExtrude& how);

/// Slices from bottom to top, at least 1 and at most `most`. What `slices` says, if it is there and
/// finite; OpenSCAD's choice otherwise.
int slice_count(const Polygons& polygons, const LinearExtrude& how, int most);

/// The outlines with their edges divided into equal parts as OpenSCAD does it, so that twisted
/// sides follow the true surface: by `segments`, or $fn, or $fa and $fs. `segments` of 0 leaves
/// them as they are, which is what OpenSCAD 2021.01 always does. At most `most` edges are made,
/// counting those that are there.
Polygons divided_outlines(const Polygons& polygons, const LinearExtrude& how, int slices,
                          double most);

/// The map from the bottom to the slice at t in 0..1, without the shift along the direction.
Vec2 slice_point(const LinearExtrude& how, double t, Vec2 bottom);

}  // namespace whittle

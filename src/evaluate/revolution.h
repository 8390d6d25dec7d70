// rotate_extrude as true curves: cones, cylinders and planes.
#pragma once

#include <vector>

#include "evaluate/budget.h"
#include "flat/polygons.h"
#include "model/document.h"
#include "model/model.h"

namespace whittle {

/// What one trapezoid of the profile sweeps: a frustum from z to z + outer.h, without one inside.
struct Ring {
  double z = 0;
  Cylinder outer;
  Cylinder inner;  ///< with both radii 0 there is none
};

/// The full revolution of polygons (x: radius, y: height; all x >= 0), cut at the heights of its
/// corners. Parts of several heights between the same two edges are one ring. Works on the budget.
std::vector<Ring> rings(const Polygons& profile, Budget& budget);

/// Convex prisms about the z axis whose union is the part of space that a partial turn sweeps, out
/// to `radius` at least.
std::vector<Polyhedron> wedges(const RotateExtrude& how, double radius, double z0, double z1);

}  // namespace whittle

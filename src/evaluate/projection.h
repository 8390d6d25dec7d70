// projection(): solids as flat shapes.
#pragma once

#include <vector>

#include "evaluate/solid_parts.h"
#include "flat/polygons.h"
#include "shape/triangle_mesh.h"

namespace whittle {

/// Loops on z = 0 that wind about each point as often as a line up through it leaves the mesh: they
/// are where faces that look up end. Precondition: the mesh is closed, and its triangles wind about
/// no point a negative number of times.
std::vector<Contour> shadow_outlines(const TriangleMesh& mesh);

/// What of a part lies in z = 0: in it just below the plane, or just above, so that a face in the
/// plane counts. Corners that are as near to the plane as what coincides lie in it.
Polygons section_of(const SolidPart& part, Budget& budget);

}  // namespace whittle

// Which triangles of a mesh lie in one plane.
#pragma once

#include "shape/triangle_mesh.h"

namespace whittle {

/// Fills the facets of a closed mesh, and which one every triangle is in. From the largest
/// triangles on, a facet takes in neighbours as long as all their corners are within `tolerance` of
/// the first one's plane; slivers, whose own plane means nothing, go with a neighbour. The plane of
/// a facet is the mean of its triangles', and square to an axis where all its corners are in such a
/// plane to within the tolerance.
void find_facets(TriangleMesh& mesh, double tolerance);

}  // namespace whittle

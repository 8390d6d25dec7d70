// Which triangles of a mesh lie in one plane.
#pragma once

#include "shape/triangle_mesh.h"

namespace whittle {

/// Fills the facets of a closed mesh, and the facet of every triangle. A facet starts at the
/// largest triangle that has none, and takes in neighbours as long as all their corners are within
/// `tolerance` of its plane. Slivers, whose own plane means nothing, go with a neighbour. A facet's
/// plane is the mean of its triangles' planes, or a plane square to an axis if all its corners are
/// in one to within the tolerance.
void find_facets(TriangleMesh& mesh, double tolerance);

}  // namespace whittle

// The last step: numbers for corners, coordinates, and edges that would be there twice.
#pragma once

#include <cstdint>
#include <vector>

#include "boundary/fill_faces.h"
#include "boundary/solid_mesh.h"

namespace whittle {

/// `owners`: of every sheet, by sheet. `half_spaces`: the first of every plane. Coordinates are
/// divided by `per_unit` and moved by `origin`.
SolidMesh finish(const FilledFaces& filled, const FaceOutlines& outlines,
                 const std::vector<Pieces::Owner>& owners, const std::vector<uint32_t>& half_spaces,
                 const ExactGeometry& geometry, double per_unit, Vec3 origin,
                 const Workers& workers);

}  // namespace whittle

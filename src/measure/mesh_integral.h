// Integrals over a solid that its boundary is known of.
#pragma once

#include "boundary/solid_mesh.h"
#include "measure/moments.h"

namespace whittle {

/// By the divergence theorem, coordinates relative to `origin`. Corners may be off by
/// `corner_error`, world units.
Integral mesh_integral(const SolidMesh& mesh, Vec3 origin, double corner_error);

}  // namespace whittle

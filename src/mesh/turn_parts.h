// Parts of a mesh that are turned outward.
#pragma once

#include <vector>

#include "base/vec.h"
#include "mesh/edges.h"
#include "mesh/turn_faces.h"

namespace whittle {

/// If the volume of all closed parts is negative, all are turned. Then a part of negative volume is
/// turned if no other is around it; else it is a cavity. Where there is so much inside out that
/// asking takes more than a second or so, the rest of it stays as it is.
void turn_parts(const std::vector<Vec3>& points, std::vector<Corners>& triangles,
                const MeshParts& parts);

}  // namespace whittle

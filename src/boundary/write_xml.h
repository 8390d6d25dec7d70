// The formats of solids that are XML.
#pragma once

#include <string>

#include "base/result.h"
#include "base/workers.h"
#include "boundary/solid_mesh.h"

namespace whittle {

/// AMF (ISO/ASTM 52915) as plain text, as OpenSCAD writes it.
std::string write_amf(const SolidMesh& mesh);

/// 3MF (the 3MF Consortium's core specification 1.3). Colours are base materials; what has none has
/// OpenSCAD's, if anything else has one.
Result<std::string> write_3mf(const SolidMesh& mesh, const Workers& workers);

}  // namespace whittle

// Files of a solid's boundary: what printers' programs read.
#pragma once

#include <string>

#include "base/result.h"
#include "base/workers.h"
#include "boundary/solid_mesh.h"
#include "boundary/stl_loss.h"

namespace whittle {

enum class SolidFormat {
  kStl,       ///< binary
  kAsciiStl,  ///< the same as text
  kOff,
  kObj,
  kAmf,  ///< without colours, as OpenSCAD's
  k3mf,  ///< with colours
};

struct SolidFile {
  std::string bytes{};
  /// Triangles of which two corners are one in STL's 32-bit floats are left out, each with all of
  /// its edges, so that what is left is closed.
  StlLoss lost{};
};

/// STL has 32-bit floats and no numbers of corners; the others have the shortest decimals that are
/// the doubles, and numbers. Units are millimetres where a format has any. The same whatever the
/// number of threads. A kInput error if the format cannot hold so much.
Result<SolidFile> write_solid(const SolidMesh& mesh, SolidFormat format, const Workers& workers);

}  // namespace whittle

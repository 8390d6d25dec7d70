// Files of a solid's boundary: what printers' programs read.
#pragma once

#include <cstddef>
#include <string>

#include "boundary/solid_mesh.h"

namespace whittle {

enum class SolidFormat {
  kStl,       ///< binary
  kAsciiStl,  ///< the same as text
  kOff,
  kObj,
};

struct SolidFile {
  std::string bytes;
  /// Triangles of which two corners are one in STL's 32-bit floats. They are left out, each with
  /// all of its edges, so that what is left is closed.
  size_t left_out = 0;
};

/// STL has 32-bit floats and no numbers of corners; OFF and OBJ have the shortest decimals that are
/// the doubles, and numbers.
SolidFile write_solid(const SolidMesh& mesh, SolidFormat format);

}  // namespace whittle

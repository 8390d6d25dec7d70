// Views that have names: the six sides of a solid, and the one that shows three of them alike.
#pragma once

#include "base/vec.h"

namespace whittle {

enum class NamedView {
  kFront,   ///< from -y, z up
  kBack,    ///< from +y
  kLeft,    ///< from -x
  kRight,   ///< from +x
  kTop,     ///< from +z, y up
  kBottom,  ///< from -z, as one sees the part when it is tipped over backwards
  kIso,     ///< isometric: front, right and top are seen at one angle
};

/// OpenSCAD's Euler angles of a view, degrees, as ViewOptions::rotation_degrees has them.
Vec3 rotation_of(NamedView view);

}  // namespace whittle

// Where a line between two points of the world appears in a picture.
#pragma once

#include <optional>

#include "trace/camera.h"

namespace whittle {

/// The ends in the picture, x and y in pixels. In place of the depth in z stands what is linear
/// along the line there: 1 / depth, or of an orthographic camera the depth itself.
struct ProjectedLine {
  Vec3 from, to;
};

/// The line, clipped to the picture and a few pixels around it; none if nothing is left.
std::optional<ProjectedLine> project_line(const Camera& camera, Vec3 from, Vec3 to);

}  // namespace whittle

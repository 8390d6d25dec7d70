// A coarse picture in the place of a fine one.
#pragma once

#include "base/workers.h"
#include "image/picture.h"
#include "trace/camera.h"

namespace whittle {

/// The camera whose picture has one pixel where that one's has scale * scale. It reaches over the
/// picture's sides where they are no multiple of the scale, equally far to the left and right, and
/// to the top and bottom.
Camera coarse_camera(const Camera& camera, int scale);

/// The picture of coarse_camera(), interpolated to the size of the fine one.
Picture enlarged(const Picture& coarse, int scale, int width, int height, const Workers& workers);

}  // namespace whittle

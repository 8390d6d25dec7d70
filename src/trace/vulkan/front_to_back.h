// The cells that a camera can see, in the order in which its rays meet them.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/camera.h"
#include "trace/pixel_rect.h"
#include "trace/vulkan/flatten.h"

namespace whittle {

/// One cell to draw.
struct VisibleCell {
  uint32_t cell;
  /// It reaches to the eye's plane or far beyond the picture's sides, so its corners have no good
  /// place in the picture: every pixel must look.
  bool is_wide;
};

/// No ray of the camera meets a later cell before an earlier one. Cells that lie outside of what
/// the tile of the picture shows, grown by `margin` pixels, may be missing. `eye`: local
/// coordinates. Writes to `cells`.
void order_front_to_back(const FlatCells& flat, const Camera& camera, Vec3 eye,
                         const PixelRect& tile, double margin, std::vector<VisibleCell>& cells);

}  // namespace whittle

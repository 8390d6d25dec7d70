// A camera that goes round a solid.
#pragma once

#include "trace/camera.h"
#include "trace/view.h"

namespace whittle {

/// The camera after a turn about the vertical line through a point, counter-clockwise as seen from
/// above.
Camera turned(Camera camera, Vec3 about, double degrees);

/// How far all that reaches which a solid sweeps when it is turned about the vertical line through
/// a point: never less, and at most half a percent more than it does. `reach` tells of the solid.
Reach swept_reach(const Reach& reach, Vec3 about);

/// Where a camera starts, and the vertical line that it goes round.
struct Turntable {
  Camera first;
  Vec3 axis;

  /// The camera of a frame among all of one turn. Precondition: 0 <= frame < frames.
  Camera at(int frame, int frames) const {
    return frame == 0 ? first : turned(first, axis, 360.0 * frame / frames);
  }
};

}  // namespace whittle

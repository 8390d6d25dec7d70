// Lines along the edges of a picture, from facts: what two rays next to each other see.
//
// Based on: what technical drawings call feature edges; the paper draws none. A pixel at an edge is
// looked at through samples that are spread over twice its width as a tent; those that see another
// face than its middle does say how near the edge is. So lines are antialiased like all else.
#pragma once

#include "base/vec.h"
#include "trace/camera.h"
#include "trace/frame.h"
#include "trace/tracer.h"

namespace whittle {

/// What is seen through one place, as far as lines go by it. Relative to the eye.
struct Spot {
  uint32_t id = 0;  ///< 0: nothing
  Vec3f point, normal, direction;
  float pixel = 0;  ///< model units that a pixel is wide there

  Spot(const Camera& camera, PixelPosition place, const Hit& hit);
};

/// Pixels by which each of the two lies off the tangent plane of the other, along its ray: the
/// lesser, so that it is small on one face however steeply that is seen.
float pixels_apart(const Spot& a, const Spot& b);

/// How strong the line is between two spots, 0 to 1: 1 at a silhouette, less at a crease; 0 within
/// a face, where faces of two primitives go on without a bend, and between facets of a curve.
float line_between(const Spot& a, const Spot& b);

}  // namespace whittle

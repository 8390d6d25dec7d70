// How closely a picture looks at a model: what cells should be as small as.
#pragma once

#include "base/box.h"
#include "trace/tracer.h"

namespace whittle {

/// So many rays would meet the longest edge of the region, squared, if all of it were seen as large
/// as its nearest point. About the picture's pixels where the region fills the picture, and many
/// more where a small part of it does; infinite if the eye is level with it. What is empty or
/// hidden counts, so this is a bound.
double rays_at_most(const Camera& camera, const Box& region);

/// The same of the nearest hit, as far as some rays spread over the picture tell; 0: nothing is
/// hit. `tracer` is one of the model's.
double rays_at_nearest_hit(Tracer& tracer, const Camera& camera, const Box& region);

}  // namespace whittle

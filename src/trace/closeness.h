// How closely a picture looks at a model, which decides how small cells should be.
#pragma once

#include "base/box.h"
#include "trace/tracer.h"

namespace whittle {

/// The number of rays that would meet a square as long as the region's longest edge, if all of it
/// were as close as the region's nearest point. About the number of pixels if the region fills the
/// picture, and many more if a small part of it does; infinite if the nearest point is beside the
/// eye. It is an upper bound, since empty and hidden parts count.
double rays_at_most(const Camera& camera, const Box& region);

/// The same for the nearest hit among some rays spread over the picture; 0 if none of them hits.
/// `tracer` is one of the model's.
double rays_at_nearest_hit(Tracer& tracer, const Camera& camera, const Box& region);

}  // namespace whittle

// What reading takes from the stages behind it.
#pragma once

#include "base/box.h"
#include "model/model.h"

namespace whittle {

/// The tight box of a solid (subdivide/solid_bounds.h), for ReadOptions::solid_box; of one without
/// end, or too large to be lowered, its bounds.
Box tight_box(const Model& model);

}  // namespace whittle

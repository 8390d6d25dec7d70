// A camera's way around a model: what pictures cost whose cells are kept from step to step.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/result.h"
#include "whittle/renderer.h"

namespace whittle {

/// Pictures in steps of one degree about the vertical through the middle of the model's bounds.
/// Each is made twice: by one renderer that keeps its cells and refines all that become open, and
/// by another afresh, where rays come. Tells of every step the milliseconds of both, from the moved
/// camera to the facts, and how many cells were refined, of all that a fresh tree refines. A kInput
/// error if the two pictures ever differ in a bit.
Result<nlohmann::ordered_json> measure_orbit(const Model& model, const RendererSettings& settings,
                                             const Camera& start, int steps);

}  // namespace whittle

// A camera that moves around a model: what pictures cost if cells are kept from step to step.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/result.h"
#include "whittle/renderer.h"

namespace whittle {

/// Pictures in steps of one degree about the vertical through the middle of the model's bounds.
/// Each is made twice, with cells made where rays come: by one renderer that keeps its cells, and
/// by another afresh. Tells of every step the milliseconds of both, from the moved camera to the
/// facts, and how many cells the first refined, of all that a fresh tree has to refine. A kInput
/// error if the two pictures ever differ in a bit.
Result<nlohmann::ordered_json> measure_orbit(const Model& model, const RendererSettings& settings,
                                             const Camera& start, int steps);

}  // namespace whittle

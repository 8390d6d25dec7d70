// A camera's way around a model: what pictures cost whose cells are kept from step to step.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/result.h"
#include "whittle/renderer.h"

namespace whittle {

/// Pictures in steps of one degree about the vertical through the middle of the model's bounds.
/// Each is made twice: by one renderer that keeps its cells, and by another afresh. Tells of every
/// step the milliseconds of both from cells to facts, and the cells that both refined. The start is
/// no step: there all is refined that its picture may meet. A kInput error if the two ever differ
/// in a bit.
Result<nlohmann::ordered_json> measure_orbit(const Model& model, const RendererSettings& settings,
                                             const Camera& start, int steps);

}  // namespace whittle

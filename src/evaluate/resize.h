// resize() of solids.
#pragma once

#include <cstdint>

#include "evaluate/budget.h"
#include "evaluate/evaluate.h"
#include "model/document.h"
#include "model/model.h"

namespace whittle {

/// Makes the transform `node`, the last of the model that holds others, the one that gives what it
/// holds the size that is asked for.
void resize_solid(Model& model, uint32_t node, const Resize& how, const EvaluateOptions& options,
                  Budget& budget);

}  // namespace whittle

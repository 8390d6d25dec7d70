// Lowering: from the model to one formula whose literals are numbered half-spaces. Transforms are
// folded into coefficients, a difference becomes "and not", nested operators of one kind become
// one, and equal or complementary half-spaces get one number.
#pragma once

#include "base/result.h"
#include "base/workers.h"
#include "lower/scene.h"
#include "model/model.h"

namespace whittle {

/// Linear in the model (half-spaces are found again by hashing). Fails only if the model has more
/// faces or nodes than a token can number (2^29). Without workers all is done on this thread; the
/// scene is the same with any number of them.
Result<Scene> lower(const Model& model, const Workers* workers = nullptr);

}  // namespace whittle

// Statements that move or paint what they hold.
#pragma once

#include "base/affine.h"
#include "csg/statements.h"
#include "model/model.h"
#include "model/warnings.h"

namespace whittle {

/// kMultmatrix, kTranslate, kRotate, kScale or kMirror.
Affine make_transform(const Statement& statement, Warnings& warnings);

/// Components above 1 are 1, negative ones are unset (-1).
Rgba make_color(const Statement& statement, Warnings& warnings);

}  // namespace whittle

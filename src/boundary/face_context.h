// Where the surface of one body matters to a formula.
#pragma once

#include <cstdint>
#include <span>

#include "lower/scene.h"

namespace whittle {

/// What the rest of a formula must say for the value of one body to matter: a conjunction of the
/// operands beside it and beside all groups around it, complemented where the group is a
/// disjunction. `formula`: over a scene's faces and units, of which the body is one, once, whole.
/// False if it is not in it. `is_negated`: whether the body is.
bool context_of(const Scene& scene, std::span<const Token> formula, uint32_t unit, Formula& context,
                bool& is_negated);

}  // namespace whittle

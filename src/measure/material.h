// Which part of a solid is whose.
//
// A point of the solid belongs to the primitive that is reached from the top of the tree by going,
// at each operator, to the first operand that holds it: of a union the first in file order, of a
// difference what is cut, of an intersection the first operand.
#pragma once

#include <functional>

#include "base/result.h"
#include "lower/scene.h"

namespace whittle {

/// The formula of all points that belong to one of the primitives for which `is_wanted(id)` holds.
/// A kMachine error if it takes more than `most_tokens`.
Result<Formula> material_of(const Scene& scene, const std::function<bool(uint32_t id)>& is_wanted,
                            size_t most_tokens);

}  // namespace whittle

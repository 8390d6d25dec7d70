// Where the nodes of a model can be.
#pragma once

#include <cstdint>
#include <functional>

#include "base/box.h"
#include "model/model.h"

namespace whittle {

/// Goes through the nodes that take part in the solid, operands before their operators, and says
/// where each can be: union of boxes, intersection of boxes, difference = its first operand's box.
/// box_of(i) is instance_box() of the i-th instance. World space. Iterative.
void for_tree_boxes(const Model& model, const std::function<Box(uint32_t)>& box_of,
                    const std::function<void(uint32_t node, const Box&)>& visit);

}  // namespace whittle

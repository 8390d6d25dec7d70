// Cuts in the colour of what was cut.
#pragma once

#include <vector>

#include "model/instances.h"

namespace whittle {

/// Gives to what stands in a cutter the look of the material that the outermost difference around
/// it cuts: that of its first operand, or of an intersection's first. `looks` are the appearances()
/// of the model. False if some material has several looks: what cuts it keeps its own.
bool set_part_looks(const Model& model, std::vector<Appearance>& looks);

}  // namespace whittle

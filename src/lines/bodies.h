// Which primitives are parts of a body that was made of many.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instances.h"
#include "model/model.h"

namespace whittle {

/// By instance: the id of the body that it is a part of, if that is of several parts; else 0.
std::vector<uint32_t> bodies_of_parts(const Model& model, std::span<const Instance> instances);

}  // namespace whittle

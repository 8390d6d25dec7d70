// Finds which points are equal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/workers.h"
#include "boundary/exact_point.h"

namespace whittle {

/// The different ones among points, in the order of their first; `numbers`: which of them each is.
std::vector<ExactPoint> unify(std::span<const ExactPoint> points, const ExactGeometry& geometry,
                              const Workers& workers, std::vector<uint32_t>& numbers);

}  // namespace whittle

// Lines that go on from one another become paths.
#pragma once

#include <span>
#include <vector>

#include "lines/single_lines.h"

namespace whittle {

/// Points are rounded to multiples of `step`. Lines of one kind go on where their ends round to one
/// point and no third one ends there. Points that lie on the line between their neighbours, but for
/// rounding, are left out. By kind. Precondition: no coordinate is beyond kMostSteps steps.
std::vector<DrawnPath> chain_lines(std::span<const KindLine> lines, double step);

/// Farther out doubles do not tell one step from the next.
inline constexpr double kMostSteps = 0x1p52;

}  // namespace whittle

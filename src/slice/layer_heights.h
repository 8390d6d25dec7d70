// Which layers there are: what --z says.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle {

inline constexpr size_t kMostLayers = 100'000;

/// Numbers and OpenSCAD's ranges, start:step:end or start:end, separated by commas, in their order.
/// A range has its end where the steps reach it to rounding, as in OpenSCAD; but its values are the
/// decimals that they look like, so that 0:0.1:1 has 0.3 and not 0.30000000000000004. A kUsage
/// error, without the option's name, if the text is no such list, a range has no values, or there
/// are more than kMostLayers.
Result<std::vector<double>> parse_heights(std::string_view text);

}  // namespace whittle

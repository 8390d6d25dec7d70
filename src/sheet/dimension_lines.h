// How long something is, as a drawing says it: two extension lines, arrows between, a number.
#pragma once

#include <string_view>
#include <vector>

#include "sheet/stroke_font.h"

namespace whittle {

/// The dimension of what lies between two places: below them if they are side by side (from left to
/// right), on the left if one is below the other (`vertical`, from the top down). It takes up to
/// 3.6 heights of letters. Arrows point inwards from outside where there is no room between, and
/// the number then goes on beyond. Based on: ISO 129-1.
std::vector<Stroke> dimension_lines(Vec2 from, Vec2 to, bool vertical, std::string_view text,
                                    double letters);

}  // namespace whittle

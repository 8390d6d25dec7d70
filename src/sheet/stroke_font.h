// Letters of straight pen strokes. A picture must not depend on which fonts are installed, and a
// label needs no more.
#pragma once

#include <string_view>
#include <vector>

#include "base/vec.h"

namespace whittle {

/// A path of a pen; a single place twice is a dot.
using Stroke = std::vector<Vec2>;

/// How wide a text is, from its first stroke to its last, for capitals of that height.
double text_width(std::string_view text, double height);

/// The strokes of a text in UTF-8 that starts at a place of the baseline; x runs to the right and y
/// down, as in pictures. Latin letters, digits and signs of ASCII, degrees and times; for any other
/// character a box.
std::vector<Stroke> text_strokes(std::string_view text, Vec2 start, double height);

}  // namespace whittle

// A line drawing as SVG.
#pragma once

#include <string>
#include <string_view>

#include "lines/line_drawing.h"

namespace whittle {

/// Black lines on nothing. One group a kind, of the classes `silhouette`, `edge`, `hidden` and
/// `dimension`, and one style sheet that says how these look. `title`: what is drawn. Based on:
/// SVG 1.1.
std::string write_line_svg(const LineDrawing& drawing, std::string_view title);

}  // namespace whittle

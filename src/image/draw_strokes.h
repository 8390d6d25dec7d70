// Antialiased pen strokes over a picture: words, dimensions.
#pragma once

#include <span>

#include "image/ink.h"
#include "sheet/stroke_font.h"

namespace whittle {

/// Draws all strokes as one: where they cross there is not more ink. `width` in pixels. What lies
/// beside the picture is left out.
void draw_strokes(std::span<const Stroke> strokes, double width, const Ink& ink, Picture& picture);

/// A colour that is read on that of the picture's corner.
Vec3f readable_on(const Picture& picture);

/// The height of letters that suits a picture, pixels.
double letters_for(int width, int height);

}  // namespace whittle

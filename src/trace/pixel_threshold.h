// The paper's pixel threshold: is a cell too small in the picture to be split any further?
//
// Based on: Romeiro, Velho, de Figueiredo 2008, section 2.2. The area that a cell projects to is
// judged by the projected lengths of its edges, of which only the parts on the visible screen
// count. What we changed: a cell that covers the whole screen shows no edge at all and yet is not
// small.
#pragma once

#include "base/box.h"
#include "trace/camera.h"

namespace whittle {

/// True if every edge of the box (world coordinates) has a visible part shorter than `pixels`, so
/// also if the box is out of sight. Precondition: the box is finite. Pure, so thread-safe.
bool is_below_pixels(const Camera& camera, const Box& box, double pixels);

}  // namespace whittle

// The outlines of a drawing as OpenSCAD's --render draws them: two pixels wide.
//
// Based on: the rasterisation of wide lines without antialiasing, OpenGL 2.1 specification, section
// 3.4. A line that is more horizontal than vertical is drawn in columns, any other in rows; in each
// column or row it covers as many pixels as it is wide.
#pragma once

#include "image/picture.h"
#include "model/model.h"
#include "trace/camera.h"

namespace whittle {

/// Draws over the picture, which has the camera's size; nothing hides a line. With `antialias` n
/// above 1 each pixel is under as much of the colour as of its n * n samples are covered.
void draw_outlines(const Drawing& drawing, const Camera& camera, Rgb8 color, int antialias,
                   Picture& picture);

}  // namespace whittle

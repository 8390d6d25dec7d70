// The outlines of a drawing as OpenSCAD's --render draws them: two pixels wide.
//
// Based on: the rasterisation of wide lines without antialiasing, OpenGL 2.1 specification, section
// 3.4: a line is drawn in columns if it is nearer to lying than to standing, else in rows; in each
// it covers as many pixels as it is wide.
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

// Frames that differ, for tests of films.
#pragma once

#include "image/picture.h"

namespace whittle {

/// A few colours: stripes that move by a pixel a frame.
inline Picture striped_frame(int width, int height, int frame) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      uint8_t* rgba = picture.at(x, y);
      const bool is_red = (x + frame) % 4 < 2;
      rgba[0] = is_red ? 200 : 20;
      rgba[1] = uint8_t(40 * (y % 3));
      rgba[2] = is_red ? 10 : 220;
      rgba[3] = 255;
    }
  }
  return picture;
}

}  // namespace whittle

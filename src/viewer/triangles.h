// Triangles drawn over a picture, without any graphics library: what a user interface is made of.
#pragma once

#include <cstdint>
#include <span>

namespace whittle {

/// Pixels as X11 and most displays have them: 0xRRGGBB, rows from the top.
struct Pixels {
  uint32_t* at = nullptr;
  int width = 0, height = 0;
  int stride = 0;  ///< pixels from a row to the next
};

struct Vertex {
  float x = 0, y = 0;  ///< pixels
  float u = 0, v = 0;  ///< in the texture, 0 to 1
  uint32_t color = 0;  ///< red in the lowest byte, then green, blue, alpha; straight
};

/// One byte a texel: how much of the colour is there.
struct Texture {
  const uint8_t* at = nullptr;
  int width = 0, height = 0;
};

struct ClipRect {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< the last two just outside
};

/// Three indices a triangle. A pixel belongs to a triangle if its centre does; of two triangles
/// that share an edge exactly one has it. Colours and texture coordinates are interpolated, the
/// nearest texel is taken. What lies outside of clip or pixels is not drawn, and vertices that are
/// no numbers draw nothing.
void draw_triangles(const Pixels& pixels, const ClipRect& clip, std::span<const Vertex> vertices,
                    std::span<const uint16_t> indices, const Texture& texture);

}  // namespace whittle

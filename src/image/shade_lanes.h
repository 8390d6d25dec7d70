// The arithmetic of colours, in vector lanes. The instruction set is chosen at run time; every one
// gives the same bytes. Shader is what others use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "image/pixel_rays.h"
#include "image/srgb.h"
#include "image/style.h"
#include "trace/frame.h"
#include "trace/tracer.h"

namespace whittle {

/// All that a colour depends on besides the hit.
struct ShadeParameters {
  explicit ShadeParameters(const Camera& camera) : rays(camera) {}

  PixelRays rays;
  Style style = Style::kStudio;
  float inverse_height = 1;    ///< of the picture
  Vec3f light_from_eye;        ///< kBlinn
  Vec3f headlight;             ///< kOpenscad: one of its two opposite directions; zero: it is off
  float ambient = 0.2f;        ///< kOpenscad: what reaches every surface
  Vec3f key, fill, rim;        ///< kStudio, kPlain: unit, from the surface to the light
  Vec3f top, bottom;           ///< background
  bool has_shadows = false;    ///< kStudio, kPlain: the key light is a point
  bool has_background = true;  ///< false: the background's pixels are four zeros
  const SrgbTable* srgb = &srgb_table();
  std::vector<Vec3f> materials;  ///< base colours, by id
  uint32_t last = 0;             ///< that of ids beyond
};

/// Hits. `looks`: the material of each, where the id alone does not tell it (0 is background).
/// `shadows`: the lights that do not reach each, a bit a light (kStudio, kPlain: 1 key, 2 fill, 4
/// rim; kBlinn: 1). `openness`: kStudio: the share of its surroundings that each sees. All are
/// empty if they are not needed. Behind the last of each are zeros, so that lanes can be loaded
/// past the end.
struct SeenHits {
  std::span<const Hit> hits;
  std::vector<uint32_t> looks, shadows;  ///< or empty
  std::vector<float> openness;           ///< or empty
};

/// Colours in the style's averaging space (see Shader), an array a component. Behind the last is
/// room for lanes to be loaded and stored.
struct Colors {
  std::vector<float> r, g, b, alpha;
  size_t size = 0;

  void resize(size_t n) {
    size = n;
    for (std::vector<float>* v : {&r, &g, &b, &alpha}) v->resize(n + kMostFloatLanes);
  }
};

/// Writes the pixels of row y as four bytes each.
void shade_row(const ShadeParameters& shader, const SeenHits& seen, int y, uint8_t* rgba);

/// The colours of hits seen through any places, as many; alpha is 1, or 0 where no background is
/// wanted and nothing is hit.
void shade_samples(const ShadeParameters& shader, const SeenHits& seen,
                   std::span<const PixelPosition> places, Colors& colors);

/// Writes colours as four bytes each.
void store_colors(const ShadeParameters& shader, const Colors& colors, uint8_t* rgba);

}  // namespace whittle

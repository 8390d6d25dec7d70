// OpenSCAD's colour schemes: background, material, cut surfaces.
//
// The values are those of OpenSCAD's ColorMap.cc and color-schemes/render, those of
// evaluated solids, as --render shows them. Some schemes have another colour for a primitive that
// no operation has touched, and for all of the preview.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "image/picture.h"

namespace whittle {

struct ColorScheme {
  std::string_view name;
  Rgb8 background_top, background_bottom;  ///< the same but for gradients
  Rgb8 front;                              ///< uncoloured material
  Rgb8 back;                               ///< uncoloured cut surfaces
  Rgb8 lone;          ///< a primitive that is all of the solid, and material in the preview
  Rgb8 preview_back;  ///< cut surfaces in the preview
  Rgb8 plane{0x00, 0xBF, 0x99};    ///< a drawing
  Rgb8 outline{0xFF, 0x00, 0x00};  ///< and the lines around it
};

/// All schemes in OpenSCAD's order; the first, Cornfield, is its default.
std::span<const ColorScheme> color_schemes();

/// The scheme of that name (upper and lower case count alike), or null. The result lives forever.
const ColorScheme* find_color_scheme(std::string_view name);

/// All names, separated by ", ", for the message about an unknown one.
std::string color_scheme_names();

}  // namespace whittle

// Colours by name or in hexadecimal, as color() takes them.
#pragma once

#include <optional>
#include <string_view>

#include "model/model.h"

namespace whittle {

/// A web colour name (CSS Color Module Level 4) in any case, "transparent", or #rgb, #rgba,
/// #rrggbb, #rrggbbaa. All components of the result are set. Nothing if it is none of these.
std::optional<Rgba> parse_color(std::string_view text);

}  // namespace whittle

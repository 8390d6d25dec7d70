// --axes, --grid, --scale-bar and --title: what is drawn over a picture.
#pragma once

#include "image/overlays.h"
#include "option_group.h"

namespace whittle {

void add_overlay_options(CLI::App& app, OverlaySettings& overlays);

}  // namespace whittle

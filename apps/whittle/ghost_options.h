// What pictures show beside the solid: ghosts, and OpenSCAD's preview.
#pragma once

#include "option_group.h"
#include "render_arguments.h"

namespace whittle {

/// --ghosts and --cut-color.
void add_ghost_options(CLI::App& app, RenderArguments& a);

/// What --ghosts and --preview mean for reading, framing and shading. Fails where that is nothing.
/// To be called when the command line has been read.
Status settle_ghosts(RenderArguments& a);

}  // namespace whittle

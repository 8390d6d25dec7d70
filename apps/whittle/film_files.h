// whittle FILE --turntable N: pictures once round the solid.
#pragma once

#include <vector>

#include "render_arguments.h"
#include "render_files.h"

namespace whittle {

/// All frames are traced through the same cells. Precondition: what check_possible() asks for.
Status render_turntable(RenderArguments& a, const std::vector<Output>& outputs, Made& made);

}  // namespace whittle

// whittle FILE --views A,B,...: sheets, or a picture of each view.
#pragma once

#include <vector>

#include "render_arguments.h"
#include "render_files.h"

namespace whittle {

/// `outputs`: templates; those with {view} are a file a view, others hold all of them.
/// Precondition: what check_possible() asks for.
Status render_views(RenderArguments& a, const std::vector<Output>& outputs, Made& made);

}  // namespace whittle

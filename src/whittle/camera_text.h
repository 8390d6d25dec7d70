// A camera as OpenSCAD's command line has it.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "trace/view.h"

namespace whittle {

/// Reads the text of --camera into `base`: seven numbers `tx,ty,tz,rx,ry,rz,d` (target, degrees,
/// distance) or six `ex,ey,ez,cx,cy,cz` (eye and centre). Anything else is a kUsage error.
Result<ViewOptions> parse_camera(std::string_view text, ViewOptions base = {});

/// A given camera as --camera has it.
std::string camera_text(const ViewOptions& options);

}  // namespace whittle

// Flat shapes that come from files.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "flat/polygons.h"
#include "model/document.h"

namespace whittle {

/// Told, in words, what of an input was left out or replaced.
using Remark = std::function<void(const std::string& kind, const std::string& message)>;

/// import() of SVG and of DXF: `content` is the file's. Errors are one sentence without a place.
Result<Polygons> read_svg(std::string_view content, const Import& how, const Remark& remark);
Result<Polygons> read_dxf(std::string_view content, const Import& how, const Remark& remark);

}  // namespace whittle

// Flat shapes that come from fonts and files.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "flat/polygons.h"
#include "model/document.h"

namespace whittle {

/// Told, in words, what of an input was left out or replaced. Text says each missing font once.
using Remark = std::function<void(const std::string& kind, const std::string& message)>;

/// text(): the glyphs as OpenSCAD outlines them. `fragments` come from text.fragments as OpenSCAD
/// computes them.
Polygons text_outline(const Text& text, const Remark& remark);

/// import() of SVG and of DXF: `content` is the file's. Errors are one sentence without a place.
Result<Polygons> read_svg(std::string_view content, const Import& how, const Remark& remark);
Result<Polygons> read_dxf(std::string_view content, const Import& how, const Remark& remark);

}  // namespace whittle

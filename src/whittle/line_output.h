// From a model to the file of its line drawing.
#pragma once

#include <string>

#include "base/result.h"
#include "lines/line_drawing.h"
#include "model/model.h"
#include "sheet/sheet.h"
#include "trace/view.h"

namespace whittle {

/// The model's solid from the view's camera, which frames what it does for a picture, as SVG. A
/// kInput error, with the file's name, if there is nothing to draw: the model is flat, empty or
/// without end. `control` of draw_lines() is passed on.
Result<std::string> line_svg_of(const Model& model, const ViewOptions& view,
                                const LineSettings& settings, int threads,
                                LineStats* stats = nullptr, const LineStage& stage = {},
                                const Progress& progress = {});

/// A sheet of drawings to scale, at settings.scale, of views that have the solid's box in their
/// middles. Errors as above.
Result<std::string> sheet_svg_of(const Model& model, const SheetSettings& sheet,
                                 const LineSettings& settings, int threads,
                                 const LineStage& stage = {}, const Progress& progress = {});

}  // namespace whittle

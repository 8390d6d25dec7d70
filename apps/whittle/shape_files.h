// whittle FILE -o part.stl: files of the solid itself, or of a drawing.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "model/model.h"
#include "summary.h"
#include "whittle/export_format.h"

namespace whittle {

struct ShapeOutput {
  std::string path;
  ExportFormat format;  ///< of a solid or of a drawing
};

struct ShapeFileSettings {
  Curves curves = Curves::kAuto;  ///< that the command line asks for
  int threads = 0;
  bool quiet = false;
  bool wants_statistics = false;
};

/// An error of evaluating the solid; if there are true curves, where facets were to be made, it
/// says why.
Error explain_curves(Error error, const Model& model, Curves asked);

/// Evaluates the model once and writes all files. Says if a file holds less than the solid.
Result<GeometryFacts> write_shape_files(const Model& model, const std::vector<ShapeOutput>& outputs,
                                        const ShapeFileSettings& settings);

}  // namespace whittle

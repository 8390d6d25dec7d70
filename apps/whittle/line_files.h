// whittle FILE -o part.svg: line drawings.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "lines/line_drawing.h"
#include "model/model.h"
#include "trace/view.h"

namespace whittle {

struct LineFileSettings {
  ViewOptions view;
  LineSettings lines;
  int threads = 0;
  bool quiet = false;
  bool wants_statistics = false;
};

/// Makes the drawing once and writes all files.
Status write_line_files(const Model& model, const std::vector<std::string>& paths,
                        const LineFileSettings& settings);

}  // namespace whittle

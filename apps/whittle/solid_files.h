// whittle FILE -o part.stl: files of the solid itself.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "model/model.h"
#include "whittle/solid_output.h"

namespace whittle {

struct SolidOutput {
  std::string path;
  SolidFormat format;
};

struct SolidFileSettings {
  int threads = 0;
  bool quiet = false;
  bool wants_statistics = false;
};

/// Evaluates the solid once and writes all files. Says if a file holds less than the solid.
Status write_solid_files(const Model& model, const std::vector<SolidOutput>& outputs,
                         const SolidFileSettings& settings);

}  // namespace whittle

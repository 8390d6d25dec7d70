// whittle slice: files of a solid's layers.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "model/model.h"
#include "whittle/choices.h"

namespace whittle {

struct SliceSettings {
  std::vector<double> heights{};
  /// One of an .svg, which holds all layers; else one of a .png for each.
  std::vector<std::string> paths{};
  bool is_svg = false;
  int width = 0, height = 0;      ///< of a .png, pixels
  double pixel = 0;               ///< millimetres; 0: as small as the solid lets it be
  Curves curves = Curves::kAuto;  ///< that the command line asks for
  int threads = 0;
  bool quiet = false;
};

/// Evaluates the model once and writes all layers. Says if there is nothing in them.
Status write_slices(const Model& model, const SliceSettings& settings);

}  // namespace whittle

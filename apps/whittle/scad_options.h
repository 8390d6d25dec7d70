// Options for .scad files: what is passed on to the openscad program that evaluates them.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "host/read_file.h"
#include "option_group.h"

namespace whittle {

struct ScadArguments {
  FlattenOptions flatten;
  std::string set_variables;  ///< the last option that only a .scad file can follow; or empty
  bool hard_warnings = false;
  bool previews = false;         ///< --preview is given,
  bool thrown_together = false;  ///< as --preview=throwntogether
};

/// -D, -p, -P, --openscad and the like.
void add_scad_options(CommandLine& line, ScadArguments& scad);

/// Fails if there are options that only a .scad file can follow, and the file is none.
Status check_scad(const std::string& file, const ScadArguments& scad);

}  // namespace whittle

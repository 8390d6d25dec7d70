// OpenSCAD programs, by way of the openscad program: whittle does not know the language.
#pragma once

#include <string>

#include "base/result.h"

namespace whittle {

/// What openscad made of a program.
struct Flattened {
  std::string csg;       ///< the model as .csg text
  std::string messages;  ///< what openscad said on the way, as it said it; often warnings
};

/// Runs `openscad`, as found on PATH, on the file `path`, without a shell and in a private
/// temporary folder that is gone afterwards. Errors, in one line: kMachine if openscad is not
/// installed or cannot be run, kInput with openscad's own words if it cannot evaluate the file, or
/// says `ERROR:` of it, whatever its exit code; then as `file:line: error: openscad: ...`.
Result<Flattened> flatten_scad(const std::string& path);

}  // namespace whittle

// OpenSCAD programs, by way of the openscad program: whittle does not know the language.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "host/read_file.h"
#include "model/model.h"

namespace whittle {

/// What openscad made of a program.
struct Flattened {
  std::string csg;       ///< the model as .csg text
  std::string messages;  ///< what openscad said on the way; often warnings
  FileView view;         ///< `$vpt` and the others, as the program sets them
  std::vector<std::string>
      files;  ///< all that openscad read, as it calls them; `path` is the first
};

/// Runs openscad on the file `path`, without a shell and in a private temporary folder that is gone
/// afterwards. May be used from several threads. Errors, in one line: kMachine if openscad is not
/// installed or cannot be run, kInput with openscad's own words if it cannot evaluate the file, or
/// says `ERROR:` of it, whatever its exit code; then as `file:line: error: openscad: ...`.
Result<Flattened> flatten_scad(const std::string& path, const FlattenOptions& options = {});

/// The openscad program that is run: as an absolute path or a path from here, or none if there is
/// none of that name on PATH.
std::optional<std::string> find_openscad(const FlattenOptions& options = {});

}  // namespace whittle

// Models in files: .csg, .scad through the openscad program, meshes and drawings.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/result.h"
#include "csg/read_csg.h"

namespace whittle {

/// How openscad evaluates a .scad file: what its command line says besides the files.
struct FlattenOptions {
  std::string
      program{};         ///< a path, or a name on PATH; empty: what $OPENSCAD says, else "openscad"
  bool renders = false;  ///< `$preview` is false
  std::optional<double> time{};                 ///< `$t` of a frame
  std::vector<std::string> definitions{};       ///< `name=value` in OpenSCAD's language
  std::optional<std::string> parameter_file{};  ///< of the customizer, and a set in it
  std::optional<std::string> parameter_set{};
  std::vector<std::string> arguments{};  ///< more, passed on as they are
  std::stop_token stop{};                ///< ends openscad; what is read then is an error
};

struct FileOptions {
  /// Its `named_files` are not asked: names in a file are relative to the folder of the file.
  ReadOptions reading{};
  /// With it only files in this folder tree are read for the text, all links resolved.
  std::optional<std::string> import_root{};
  FlattenOptions flatten{};
  /// For who reads "-" again: standard input goes there when it is read, and is taken from there.
  std::optional<std::string>* standard_input = nullptr;
};

/// Reads a file; "-" is standard input. A name that ends in .scad is first evaluated by the
/// openscad program; messages then quote the statement of its .csg text that they are about. A mesh
/// or a drawing (.stl, .off, .obj, .3mf, .amf, .svg, .dxf) is read as by `import()`. Errors:
/// kInput, or kMachine if openscad cannot be run.
Result<Read> read_file(const std::string& path, const FileOptions& options = {});

/// Reads a text as that of the .csg file `path`, whatever the file holds.
Result<Read> read_edited_text(const std::string& path, const std::string& text,
                              const FileOptions& options = {});

}  // namespace whittle

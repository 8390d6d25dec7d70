// Reading models: OpenSCAD's .csg text, and .scad through the openscad program.
//
// The dialect is the one OpenSCAD dumps (and re-reads), plus the statement
// `halfspace(n = [a, b, c], d = e)`, the solid {p : n.p <= e}.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/box.h"
#include "base/result.h"
#include "model/model.h"
#include "model/statement_counts.h"
#include "model/warnings.h"
#include "whittle/options.h"

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
};

struct ReadOptions {
  Curves curves = Curves::kAuto;
  bool polish = true;  ///< rotations in `multmatrix` get back what printing took (polish.h)
  int threads = 0;     ///< that bodies are built on; 0: all
  ReadLimits limits{};
  /// What the names of files in the text are relative to; "" is the current folder. Without it the
  /// text can name no files. read_file() takes that of the file.
  std::optional<std::string> folder{};
  /// With it only files in this folder tree are read for the text, all links resolved.
  std::optional<std::string> import_root{};
  /// Whether a drawing gets its outlines (Drawing).
  bool outlines = false;
  /// The exact box of a solid (subdivide/solid_bounds.h), for resize(); without it bounds() stand
  /// for it.
  std::function<Box(const Model&)> solid_box{};
  FlattenOptions flatten{};
};

/// What was read.
struct Read {
  Model model;
  StatementCounts counts;  ///< of the text, as it is written
  /// Full messages, `file:line:column: warning: ...`: of what is written in the order of the file,
  /// then likewise of what has become of it. Many of one kind are summed up in one line.
  std::vector<std::string> warnings;
  /// The first thing that was left out or replaced, if any: then the model may not be what was
  /// meant. What stands under `%` does not count.
  std::optional<Unsupported> unsupported;
  /// That as a full message, `file:line:column: error: ...`; empty if there is nothing.
  std::string refusal;
  /// All files that were read for it: the one asked for, unless it is standard input, then those
  /// that it names, in the order in which they were first asked for.
  std::vector<std::string> files;
};

/// Reads .csg text. `file_name` is what messages call it. The result does not refer to `text`.
/// Errors are kInput with one line `file:line:column: error: ...`. One pass, linear in the text;
/// nesting costs memory, never stack.
Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options = {});

/// Reads a file; "-" is standard input. A name that ends in .scad is first evaluated by the
/// openscad program; messages then quote the statement of its .csg text that they are about. A mesh
/// or a drawing (.stl, .off, .obj, .3mf, .amf, .svg, .dxf) is read as by `import()`. Errors:
/// kInput, or kMachine if openscad cannot be run.
Result<Read> read_file(const std::string& path, const ReadOptions& options = {});

}  // namespace whittle

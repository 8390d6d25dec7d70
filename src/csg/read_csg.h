// Reading models: OpenSCAD's .csg text. Nothing here opens a file or starts a program: files that a
// text names are read by a function that is handed in.
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
#include "csg/text_source.h"
#include "model/model.h"
#include "model/statement_counts.h"
#include "model/warnings.h"
#include "whittle/options.h"

namespace whittle {

/// Places in a text are counted in 32 bits, so ReadLimits::bytes is at most this.
inline constexpr size_t kMostTextBytes = (size_t{1} << 32) - 1;

/// The content of a file that the text names, as it names it; none if there is no such file, which
/// is a warning as in OpenSCAD. Errors say why it cannot be read, without a place.
using NamedFiles = std::function<Result<std::optional<std::string>>(const std::string& name)>;

struct ReadOptions {
  Curves curves = Curves::kAuto;
  bool polish = true;  ///< rotations in `multmatrix` get back what printing took (polish.h)
  int threads = 0;     ///< 0: all
  /// A text of several times so many bytes is read in pieces of about that, on all threads. What is
  /// read, and what is said of it, is the same for any.
  size_t piece_bytes = size_t{1} << 18;
  ReadLimits limits{};
  /// Reads the files that the text names (host/named_files.h). Without it the text can name none.
  NamedFiles named_files{};
  /// Whether a drawing gets its outlines (Drawing).
  bool outlines = false;
  /// Whether what `%` marks is read, too (Model::background).
  bool background = false;
  /// The exact box of a solid (subdivide/solid_bounds.h), for resize(); without it bounds() stand
  /// for it.
  std::function<Box(const Model&)> solid_box{};
  /// The boundary of a solid (boundary/closed_mesh.h), for hulls and sums of what is cut and for
  /// projections; without it there are none of these. As EvaluateOptions::closed_mesh.
  std::function<Result<TriangleMesh>(const Model&, size_t& pieces)> closed_mesh{};
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
  /// Likewise the first file that it names and that is not there. OpenSCAD shows nothing for such a
  /// file and goes on, so it does not count as unsupported.
  std::string missing_file{};
  /// Of read_file() only: all files that were read for it, the one asked for first, unless it is
  /// standard input, then those that it names, in the order in which they were first asked for.
  std::vector<std::string> files{};
};

/// Reads .csg text. `file_name` is what messages call it. The result does not refer to `text`.
/// Errors are kInput with one line `file:line:column: error: ...`. One pass, linear in the text;
/// nesting costs memory, never stack.
Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options = {});

/// The same of a text that need not be in memory. What check_text() looks for in its beginning is
/// not looked for.
Result<Read> read_csg(TextSource& source, const std::string& file_name,
                      const ReadOptions& options = {});

}  // namespace whittle

// --summary and --summary-file: what was drawn, named as by openscad's newer versions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "option_group.h"
#include "trace/view.h"

namespace whittle {

struct SummaryArguments {
  std::vector<std::string> parts;   ///< of --summary
  std::optional<std::string> file;  ///< of --summary-file; "-": standard output

  bool is_wanted() const { return !parts.empty() || file; }
};
void add_summary_options(CLI::App& app, SummaryArguments& summary);

/// What is known of the shape.
struct GeometryFacts {
  int dimensions = 3;
  Box box{};  ///< empty or infinite ones are not told
  /// Of what was written: triangles and their corners, or the loops of a drawing.
  std::optional<size_t> facets{}, vertices{}, contours{};
};

struct SummaryFacts {
  GimbalView view{};
  GeometryFacts geometry{};
  double milliseconds = 0;
};

/// One JSON object, on one line. Without --summary, all parts are in it.
std::string summary_json(const SummaryFacts& facts, const SummaryArguments& summary);

/// The parts of --summary as lines for people, the last one's end left out.
std::string summary_lines(const SummaryFacts& facts, const SummaryArguments& summary);

}  // namespace whittle

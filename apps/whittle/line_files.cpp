#include "line_files.h"

#include <fmt/format.h>

#include "base/timing.h"
#include "console.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/line_output.h"
#include "whittle/output.h"

namespace whittle {

Status write_line_files(const Model& model, const std::vector<std::string>& paths,
                        const LineFileSettings& settings) {
  LineStats stats;
  const Stopwatch watch;
  const auto draw = [&] {
    ProgressLine progress(!settings.quiet, "evaluating");
    return line_svg_of(
        model, settings.view, settings.lines, settings.threads, &stats,
        [&progress](const char* stage) { progress.stage(stage); }, progress.share());
  };
  const Result<std::string> svg = draw();
  if (!svg) return svg.error();
  if (stats.paths == 0 && !settings.quiet)
    say(fmt::format("{}: note: nothing of it is in the drawing", model.file));
  for (const std::string& path : paths)
    if (Status written = write_output(path, *svg); !written) return written;
  if (settings.wants_statistics) {
    say_lines(fmt::format(
        "facets        {:>12}   {} edges that may be drawn, in {} parts\n"
        "paths         {:>12}   {} points\n"
        "time (ms)     {:>12.1f}   solid {:.1f}, edges {:.1f}, split {:.1f}, look {:.1f}, join "
        "{:.1f}\n"
        "memory        {:>12}\n",
        stats.facets, stats.edges, stats.parts, stats.paths, stats.points, watch.milliseconds(),
        stats.solid_ms, stats.edges_ms, stats.split_ms, stats.look_ms, stats.join_ms,
        describe_bytes(peak_memory_bytes())));
  }
  return Done{};
}

}  // namespace whittle

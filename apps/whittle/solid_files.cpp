#include "solid_files.h"

#include <fmt/format.h>

#include "base/timing.h"
#include "console.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/output.h"

namespace whittle {

Status write_solid_files(const Model& model, const std::vector<SolidOutput>& outputs,
                         const SolidFileSettings& settings) {
  BoundaryStats stats;
  const Stopwatch watch;
  const auto evaluate = [&] {
    const ProgressLine progress(!settings.quiet, "evaluating");
    return solid_of(model, settings.threads, &stats);
  };
  const Result<SolidMesh> mesh = evaluate();
  if (!mesh) return mesh.error();
  const double evaluated = watch.milliseconds();
  for (const SolidOutput& output : outputs) {
    const SolidFile file = write_solid(*mesh, output.format);
    if (file.left_out > 0 && !settings.quiet) {
      say(
          fmt::format("{}: note: {} triangles are too thin for the 32-bit floats of STL and were "
                      "left out; the mesh stays closed",
                      output.path, file.left_out));
    }
    if (Status written = write_output(output.path, file.bytes); !written) return written;
  }
  if (settings.wants_statistics) {
    say_lines(fmt::format(
        "cells         {:>12}   leaves; {} contacts{}\n"
        "pieces        {:>12}   {} edges of faces, {} of more than two\n"
        "triangles     {:>12}   {} corners; {} edges that were but rounding are gone\n"
        "time (ms)     {:>12.1f}   cells {:.1f}, cut {:.1f}, join {:.1f}, fill {:.1f}, write "
        "{:.1f}\n"
        "memory        {:>12}\n",
        stats.leaves, stats.contacts, stats.asked_all_contacts ? ", all of them" : "", stats.pieces,
        stats.outline_edges, stats.shared_edges, mesh->triangles.size(), mesh->corners.size(),
        stats.collapsed, watch.milliseconds(), stats.cells_ms, stats.cut_ms, stats.join_ms,
        stats.fill_ms, watch.milliseconds() - evaluated, describe_bytes(peak_memory_bytes())));
  }
  return Done{};
}

}  // namespace whittle

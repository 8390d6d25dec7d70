#include "shape_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/timing.h"
#include "console.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/output.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

std::string counted(size_t n, const char* one, const char* several) {
  return fmt::format("{} {}", n, n == 1 ? one : several);
}

/// What is not in an STL, and what that does to the solid.
std::string describe(const StlLoss& lost) {
  std::string text = counted(lost.triangles, "triangle is too thin", "triangles are too thin");
  text += " for the 32-bit floats of STL and left out; the mesh stays closed";
  const char* before = ", but ";
  const auto add = [&](const std::string& what) {
    text += before + what;
    before = " and ";
  };
  if (lost.holes > 0) add(counted(lost.holes, "hole through it is", "holes through it are"));
  if (lost.shells > 0) add(counted(lost.shells, "part or hollow is", "parts or hollows are"));
  return lost.holes + lost.shells > 0 ? text + " gone (the other formats have all digits)" : text;
}

void say_statistics(const BoundaryStats& stats, const SolidMesh& mesh, double total, double write) {
  say_lines(fmt::format(
      "cells         {:>12}   leaves; {} contacts{}\n"
      "pieces        {:>12}   {} edges of faces, {} of more than two\n"
      "triangles     {:>12}   {} corners; {} edges that were but rounding are gone\n"
      "time (ms)     {:>12.1f}   planes {:.1f}, faces {:.1f}, cells {:.1f}, cut {:.1f}, join "
      "{:.1f}, "
      "fill {:.1f}, write {:.1f}\n"
      "memory        {:>12}\n",
      stats.leaves, stats.contacts, stats.asked_all_contacts ? ", all of them" : "", stats.pieces,
      stats.outline_edges, stats.shared_edges, mesh.triangles.size(), mesh.corners.size(),
      stats.collapsed, total, stats.planes_ms, stats.faces_ms, stats.cells_ms, stats.cut_ms,
      stats.join_ms, stats.fill_ms, write, describe_bytes(peak_memory_bytes())));
}

/// Why there are true curves where facets were made.
std::string reason_for_curves(Curves asked) {
  return asked == Curves::kSmooth ? " (--curves smooth asks for them)"
                                  : " (more than 2048 facets around count as a true curve)";
}

Result<GeometryFacts> write_solids(const Model& model, const std::vector<ShapeOutput>& outputs,
                                   const ShapeFileSettings& settings) {
  const Workers workers(settings.threads);
  BoundaryStats stats;
  const Stopwatch watch;
  const auto evaluate = [&] {
    const ProgressLine progress(!settings.quiet, "evaluating");
    return solid_of(model, workers, &stats);
  };
  const Result<SolidMesh> mesh = evaluate();
  if (!mesh) return explain_curves(mesh.error(), model, settings.curves);
  const double evaluated = watch.milliseconds();
  for (const ShapeOutput& output : outputs) {
    const Result<SolidFile> file =
        write_solid(*mesh, std::get<SolidFormat>(output.format), workers);
    if (!file) {
      return Error{file.error().kind,
                   fmt::format("cannot write '{}': {}", output.path, file.error().message)};
    }
    if (file->lost.triangles > 0 && !settings.quiet)
      say(fmt::format("{}: note: {}", output.path, describe(file->lost)));
    if (Status written = write_output(output.path, file->bytes); !written) return written.error();
  }
  if (settings.wants_statistics)
    say_statistics(stats, *mesh, watch.milliseconds(), watch.milliseconds() - evaluated);
  GeometryFacts facts{.facets = mesh->triangles.size(), .vertices = mesh->corners.size()};
  for (const Vec3& corner : mesh->corners) facts.box.include(corner);
  return facts;
}

Result<GeometryFacts> write_drawings(const Model& model, const std::vector<ShapeOutput>& outputs,
                                     const ShapeFileSettings& settings) {
  const Result<std::vector<Contour>> outlines = drawing_of(model);
  if (!outlines) return outlines.error();
  if (settings.curves == Curves::kSmooth && has_true_curves(model)) {
    return Error{ErrorKind::kInput,
                 fmt::format("{}: error: there are true curves in it, which .svg and .dxf do not "
                             "hold here{}",
                             model.file, reason_for_curves(settings.curves))};
  }
  for (const ShapeOutput& output : outputs) {
    const std::string file = write_drawing(*outlines, std::get<DrawingFormat>(output.format));
    if (Status written = write_output(output.path, file); !written) return written.error();
  }
  GeometryFacts facts{.dimensions = 2, .contours = outlines->size()};
  for (const Contour& outline : *outlines)
    for (const Vec2& p : outline) facts.box.include({p.x, p.y, 0});
  return facts;
}

}  // namespace

Error explain_curves(Error error, const Model& model, Curves asked) {
  if (error.kind == ErrorKind::kInput && has_true_curves(model))
    error.message += reason_for_curves(asked);
  return error;
}

Result<GeometryFacts> write_shape_files(const Model& model, const std::vector<ShapeOutput>& outputs,
                                        const ShapeFileSettings& settings) {
  std::vector<ShapeOutput> solids, drawings;
  for (const ShapeOutput& output : outputs)
    (std::holds_alternative<SolidFormat>(output.format) ? solids : drawings).push_back(output);
  // A model has two dimensions or three. What asks for the other fails in the first of its kind.
  if (drawings.empty()) return write_solids(model, solids, settings);
  Result<GeometryFacts> facts = write_drawings(model, drawings, settings);
  if (!facts || solids.empty()) return facts;
  return write_solids(model, solids, settings);
}

}  // namespace whittle

#include "whittle/line_output.h"

#include <string_view>
#include <utility>

#include "lines/write_line_svg.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

/// Who knows the solid's box, and cameras that frame it.
Result<Renderer> framer_of(const Model& model, int threads) {
  RendererSettings settings;
  settings.backend = Backend::kCpu;
  settings.threads = threads;
  return Renderer::make(model, settings);
}

Error refusal(const Model& model, const std::string& why) {
  return {ErrorKind::kInput, model.file + ": error: " + why};
}

/// The drawing, if there is anything in it.
Result<LineDrawing> drawing_of(const Model& model, const Camera& camera,
                               const LineSettings& settings, int threads, LineStats& stats,
                               const LineStage& stage, const Progress& progress) {
  Result<LineDrawing> drawing =
      draw_lines(model, camera, settings, threads, &stats, stage, progress);
  if (!drawing) {
    return drawing.error().kind == ErrorKind::kInput ? refusal(model, drawing.error().message)
                                                     : drawing.error();
  }
  if (stats.facets == 0) return refusal(model, "the solid is empty");
  return drawing;
}

/// Folders are nobody's business.
std::string_view title_of(const Model& model) {
  return std::string_view(model.file).substr(model.file.rfind('/') + 1);
}

}  // namespace

Result<std::string> line_svg_of(const Model& model, const ViewOptions& view,
                                const LineSettings& settings, int threads, LineStats* stats,
                                const LineStage& stage, const Progress& progress) {
  if (model.drawing) return refusal(model, "is flat; a line drawing shows a solid");
  Result<Renderer> framer = framer_of(model, threads);
  if (!framer) return framer.error();
  LineStats made;
  const Result<LineDrawing> drawing = drawing_of(model, framer->camera(view), settings, threads,
                                                 stats != nullptr ? *stats : made, stage, progress);
  if (!drawing) return drawing.error();
  return write_line_svg(*drawing, title_of(model));
}

Result<std::string> sheet_svg_of(const Model& model, const SheetSettings& sheet,
                                 const LineSettings& settings, int threads, const LineStage& stage,
                                 const Progress& progress) {
  if (model.drawing) return refusal(model, "is flat; a sheet shows a solid");
  Result<Renderer> framer = framer_of(model, threads);
  if (!framer) return framer.error();
  const Box box = framer->framed_box();
  if (box.is_empty()) return refusal(model, "the solid is empty");
  if (!box.is_finite()) return refusal(model, "the solid has no end");
  const Sheet laid_out = sheet_to_scale(sheet, box, settings.scale);
  LineDrawing all{.is_to_scale = true, .corner = {}, .size = laid_out.size, .paths = {}};
  for (const SheetView& view : laid_out.views) {
    LineStats stats;
    Result<LineDrawing> drawing = drawing_of(model, sheet_camera(view.view, box, 1, 1, 1), settings,
                                             threads, stats, stage, progress);
    if (!drawing) return drawing.error();
    for (DrawnPath& path : drawing->paths) {
      for (Vec2& point : path.points) point = point + view.middle();
      all.paths.push_back(std::move(path));
    }
  }
  for (const Stroke& line : laid_out.lines)
    all.paths.push_back({LineKind::kDimension, false, line});
  return write_line_svg(all, title_of(model));
}

}  // namespace whittle

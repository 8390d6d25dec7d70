#include "whittle/line_output.h"

#include <string_view>

#include "lines/write_line_svg.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

/// The camera that a picture would have.
Result<Camera> camera_of(const Model& model, const ViewOptions& view, int threads) {
  RendererSettings settings;
  settings.backend = Backend::kCpu;
  settings.threads = threads;
  Result<Renderer> renderer = Renderer::make(model, settings);
  if (!renderer) return renderer.error();
  return renderer->camera(view);
}

}  // namespace

Result<std::string> line_svg_of(const Model& model, const ViewOptions& view,
                                const LineSettings& settings, int threads, LineStats* stats,
                                const LineStage& stage, const Progress& progress) {
  const auto refused = [&](const std::string& why) {
    return Error{ErrorKind::kInput, model.file + ": error: " + why};
  };
  if (model.drawing) return refused("is flat; a line drawing shows a solid");
  const Result<Camera> camera = camera_of(model, view, threads);
  if (!camera) return camera.error();
  LineStats made;
  LineStats& s = stats != nullptr ? *stats : made;
  const Result<LineDrawing> drawing =
      draw_lines(model, *camera, settings, threads, &s, stage, progress);
  if (!drawing) {
    return drawing.error().kind == ErrorKind::kInput ? refused(drawing.error().message)
                                                     : drawing.error();
  }
  if (s.facets == 0) return refused("the solid is empty");
  // Folders are nobody's business.
  return write_line_svg(*drawing, std::string_view(model.file).substr(model.file.rfind('/') + 1));
}

}  // namespace whittle

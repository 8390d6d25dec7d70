#include "sheet_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/workers.h"
#include "draw_picture.h"
#include "image/draw_strokes.h"
#include "image/png.h"
#include "image/shade.h"
#include "line_files.h"
#include "whittle/line_output.h"

namespace whittle {
namespace {

/// Lays a picture over a part of another, which is opaque or empty there.
void paste(const Picture& from, int left, int top, Picture& to) {
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      const uint8_t* over = from.at(x, y);
      uint8_t* under = to.at(left + x, top + y);
      if (under[3] == 0) {
        std::copy_n(over, 4, under);
        continue;
      }
      for (int c = 0; c < 3; ++c)
        under[c] = uint8_t((over[c] * over[3] + under[c] * (255 - over[3]) + 127) / 255);
    }
  }
}

/// All views in one picture.
Result<Picture> draw_sheet(const RenderArguments& a, const Sheet& sheet, Renderer& renderer,
                           ProgressLine& progress) {
  Picture picture(a.view.width, a.view.height);
  const Rgb8 color = effective_scheme(a.shading).background_top;
  const uint8_t paper[4] = {color.r, color.g, color.b, 255};
  if (!a.no_background)
    for (size_t i = 0; i < picture.rgba.size(); i += 4) std::copy_n(paper, 4, &picture.rgba[i]);
  RenderArguments one = a;
  // A view's own ground and background would end where its place does.
  one.shading.ground = false;
  one.shading.background = false;
  one.overlays = {};
  for (const SheetView& view : sheet.views) {
    const Camera camera = sheet_camera(view.view, renderer.framed_box(), sheet.scale,
                                       int(view.size.x), int(view.size.y));
    const Result<Drawn> drawn = draw_picture(one, {}, camera, renderer, progress);
    if (!drawn) return drawn.error();
    paste(drawn->picture, int(view.corner.x), int(view.corner.y), picture);
  }
  const double letters = letters_for(picture.width, picture.height);
  draw_strokes(sheet.lines, std::max(1.0, letters / 9), {readable_on(picture), 0.9f}, picture);
  return picture;
}

Status write_sheets(const RenderArguments& a, const std::vector<Output>& outputs,
                    const SheetSettings& settings, const Model& model, Renderer& renderer,
                    ProgressLine& progress) {
  const Box box = renderer.framed_box();
  if (model.drawing || box.is_empty() || !box.is_finite()) {
    return Error{ErrorKind::kInput, fmt::format("{}: error: {}; a sheet shows a solid", model.file,
                                                model.drawing    ? "is flat"
                                                : box.is_empty() ? "the solid is empty"
                                                                 : "the solid has no end")};
  }
  const Result<Sheet> sheet = sheet_of_pixels(settings, box, a.view.width, a.view.height);
  if (!sheet) return sheet.error();
  const Result<Picture> picture = draw_sheet(a, *sheet, renderer, progress);
  if (!picture) return picture.error();
  const Workers workers(a.renderer.threads);
  const std::string bytes = encode_png(*picture, a.no_background, &workers);
  for (const Output& output : outputs)
    if (Status written = write_output(output.path, bytes); !written) return written;
  return Done{};
}

/// Drawings of each view.
Status write_drawings(const RenderArguments& a, const std::vector<Output>& outputs,
                      const Read& read, Made& made) {
  RenderArguments one = a;
  for (const NamedView view : a.sheet.views) {
    one.view.named = view;
    std::vector<Output> files = outputs;
    std::vector<std::string> paths;
    for (Output& file : files) paths.push_back(file.path = view_output(a, file.path, view));
    const Status written = write_line_files(
        read.model, paths,
        {one.view, line_settings(a), a.renderer.threads, a.loading.quiet, a.wants_statistics});
    if (!written) return written;
    made.add(files, read);
  }
  return Done{};
}

/// Drawings of all views.
Status write_drawn_sheets(const RenderArguments& a, const std::vector<Output>& outputs,
                          const SheetSettings& settings, const Model& model,
                          ProgressLine& progress) {
  const Result<std::string> svg = sheet_svg_of(
      model, settings, line_settings(a), a.renderer.threads,
      [&progress](const char* stage) { progress.stage(stage); }, progress.share());
  if (!svg) return svg.error();
  for (const Output& output : outputs)
    if (Status written = write_output(output.path, *svg); !written) return written;
  return Done{};
}

}  // namespace

Status render_views(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  made.code = code_for(*read, a.loading, "picture");
  const SheetSettings settings{a.sheet.views, a.sheet.angle, a.overlays.title};
  std::vector<Output> pictures, sheets, drawings, drawn_sheets;
  for (const Output& output : outputs) {
    if (has_word(output.path, "view")) {
      (output.is_picture() ? pictures : drawings).push_back(output);
      continue;
    }
    const Output sheet{still_output(a, output.path), output.format};
    (output.is_picture() ? sheets : drawn_sheets).push_back(sheet);
    made.add({sheet}, *read);
  }
  ProgressLine progress(!a.loading.quiet, "subdividing");
  if (!pictures.empty() || !sheets.empty()) {
    Result<Renderer> renderer = Renderer::make(read->model, a.renderer);
    if (!renderer) return renderer.error();
    RenderArguments one = a;
    one.view.named = a.sheet.views[0];
    if (Status prepared = renderer->prepare(renderer->camera(one.view)); !prepared) return prepared;
    for (const NamedView view : pictures.empty() ? std::vector<NamedView>() : a.sheet.views) {
      one.view.named = view;
      std::vector<Output> files = pictures;
      for (Output& file : files) file.path = view_output(a, file.path, view);
      const Result<Drawn> drawn =
          draw_picture(one, files, renderer->camera(one.view), *renderer, progress);
      if (!drawn) return drawn.error();
      progress.without_line([&] { say_of_picture(a, read->model, *drawn, made); });
      if (Status written = write_pictures(one, files, *drawn); !written) return written;
      made.add(files, *read);
    }
    if (!sheets.empty()) {
      const Status written = write_sheets(a, sheets, settings, read->model, *renderer, progress);
      if (!written) return written;
    }
  }
  if (!drawings.empty()) {
    if (Status done = write_drawings(a, drawings, *read, made); !done) return done;
  }
  if (drawn_sheets.empty()) return Done{};
  return write_drawn_sheets(a, drawn_sheets, settings, read->model, progress);
}

}  // namespace whittle

// What the command that renders is told, and what of it cannot be.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command_line.h"
#include "film_options.h"
#include "openscad_options.h"
#include "output_template.h"
#include "overlay_options.h"
#include "reference.h"
#include "sheet_options.h"
#include "summary.h"
#include "whittle/export_format.h"
#include "whittle/line_output.h"
#include "whittle/output.h"

namespace whittle {

struct Output {
  std::string path;
  ExportFormat format;

  bool is_picture() const { return std::holds_alternative<FileFormat>(format); }
  bool is_film() const { return std::holds_alternative<FilmFormat>(format); }
  bool is(FileFormat picture) const { return format == ExportFormat(picture); }
};

struct RenderArguments {
  std::vector<std::string> files;
  std::string file;  ///< of them, the one that is drawn
  std::vector<std::string> outputs;
  std::optional<ExportFormat> export_format;
  LineSettings lines;
  std::optional<double> scale;  ///< of line drawings
  Loading loading;
  ViewOptions view;
  ShadeSettings shading;
  Pass pass = Pass::kColor;
  bool no_background = false;
  bool xray = false;
  int antialias = 0;  ///< 0: what suits the style
  RendererSettings renderer;
  SubdivisionArguments subdivision;
  OpenscadArguments openscad;
  FilmArguments film;
  SheetArguments sheet;
  OverlaySettings overlays;
  SummaryArguments summary;
  ReferenceArguments reference;
  bool wants_statistics = false;

  /// Whether there are several pictures, which have numbers.
  bool moves() const { return openscad.animation.frames > 0 || film.turntable > 0; }
};

void add_options(CommandLine& line, RenderArguments& a);

/// Of line drawings, at the scale that was chosen.
LineSettings line_settings(const RenderArguments& a);

/// The outputs as they are given: templates.
Result<std::vector<Output>> choose_outputs(const RenderArguments& a);

/// All outputs, as templates.
std::vector<OutputTemplate> templates_of(const RenderArguments& a,
                                         const std::vector<Output>& outputs);

/// Where an output goes: what has no number, one of --views, and a frame. Precondition:
/// check_templates() found no mistake.
std::string still_output(const RenderArguments& a, const std::string& pattern);
std::string view_output(const RenderArguments& a, const std::string& pattern, NamedView view);
std::string frame_output(const RenderArguments& a, const std::string& pattern, int frame);

/// Fails for what can not be done, before it has begun.
Status check_possible(const RenderArguments& a, const std::vector<Output>& outputs);

}  // namespace whittle

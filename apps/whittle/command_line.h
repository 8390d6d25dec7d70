// The options that commands share.
#pragma once

#include <optional>
#include <string>

#include "host/read_file.h"
#include "image/shade.h"
#include "limits.h"
#include "option_group.h"
#include "scad_options.h"
#include "trace/view.h"
#include "whittle/renderer.h"

namespace whittle {

struct Loading {
  Curves curves = Curves::kAuto;
  bool outlines = false;  ///< of drawings
  bool polish = true;
  ReadLimits limits;
  std::optional<std::string> import_root;
  bool strict = false;
  bool lenient = false;
  bool quiet = false;
  ScadArguments scad;
  const ViewOptions* view = nullptr;  ///< openscad is told its camera
  const int* threads = nullptr;       ///< what --threads says
};
void add_loading_options(CommandLine& line, Loading& loading);
/// --lenient, of what makes pictures.
void add_lenient_option(CLI::App& app, Loading& loading);
/// Fails for what the options ask of a file that is not of the kind. Before anything is read.
Status check_loading(const std::string& file, const Loading& loading);
/// What equals OpenSCAD's picture has OpenSCAD's facets, unless true curves were chosen.
void suit_style(Style style, Loading& loading);
FileOptions read_options(const Loading& loading);
/// Says the warnings; or with `strict` and anything that is not supported, the error for that.
Status say_warnings(const Read& read, const Loading& loading);
/// Reads a file, shows the progress, and says its warnings.
Result<Read> load(const std::string& file, const Loading& loading);

/// Says if nothing is seen, and why.
void say_if_nothing_is_seen(const Model& model, const Frame& frame, const Loading& loading);
/// The exit code of a picture that was written: what was left out does not pass for success, unless
/// that was asked for. Says so.
int code_for(const Read& read, const Loading& loading);

/// --imgsize, --camera and what belongs to them.
void add_view_options(CLI::App& app, ViewOptions& view);
/// The same; openscad is told of the camera.
void add_view_options(CLI::App& app, ViewOptions& view, Loading& loading);

/// --colorscheme and --light.
void add_color_options(CLI::App& app, ShadeSettings& shading);

/// --shadows.
void add_shadow_option(CLI::App& app, ShadeSettings& shading);

/// --backend, --device, --threads and the like. OpenSCAD's own backends stand for `auto`: the
/// picture is the same. Files are read on as many threads.
void add_machine_options(CLI::App& app, RendererSettings& settings, Loading& loading);

/// A device that is named is taken, so `auto` is the backend that has devices then; fails if
/// another one was chosen. After the command line is read.
Status settle_device(RendererSettings& settings);

struct SubdivisionArguments {
  bool paper = false;
  std::optional<uint32_t> leaf_size;
  std::optional<SplitRule> split;
  std::optional<size_t> memory;
  std::optional<double> pixel_threshold;
  std::optional<bool> ignore_small;
};
void add_subdivision_options(CLI::App& app, SubdivisionArguments& arguments);
/// The paper's rules if asked for, and then what was asked for one by one.
void apply(const SubdivisionArguments& arguments, RendererSettings& settings);

}  // namespace whittle

// The options that commands share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/read_file.h"
#include "image/shade.h"
#include "limits.h"
#include "option_group.h"
#include "scad_options.h"
#include "section_options.h"
#include "trace/view.h"
#include "whittle/renderer.h"

namespace whittle {

struct Loading {
  Curves curves = Curves::kAuto;
  bool outlines = false;        ///< of drawings
  bool background = false;      ///< what `%` marks is read, too
  bool draws_previews = false;  ///< --preview=throwntogether can be followed
  bool polish = true;
  ReadLimits limits;
  std::optional<std::string> import_root;
  bool strict = false;
  bool lenient = false;
  bool quiet = false;
  ScadArguments scad;
  SectionArguments section;
  const ViewOptions* view = nullptr;  ///< openscad is told its camera
  const int* threads = nullptr;       ///< what --threads says
  /// As FileOptions::standard_input; null: it is read once.
  std::shared_ptr<std::optional<std::string>> standard_input;
};
void add_loading_options(CommandLine& line, Loading& loading);
/// --lenient, of what makes pictures.
void add_lenient_option(CLI::App& app, Loading& loading);
/// Fails if options are given that a file of this kind does not have. Called before it is read.
Status check_loading(const std::string& file, const Loading& loading);
/// Style openscad takes OpenSCAD's facets, unless true curves were chosen, and outlines.
void suit_style(Style style, Loading& loading);
FileOptions read_options(const Loading& loading);
/// Prints the warnings. An error instead if --strict or --hardwarnings refuses something among
/// them.
Status say_warnings(const Read& read, const Loading& loading);
/// Reads a file, shows the progress, says its warnings, and opens it as --section and its like ask.
Result<Read> load(const std::string& file, const Loading& loading);

/// Says if nothing is seen, and why.
void say_if_nothing_is_seen(const Model& model, const Frame& frame, const Loading& loading);
/// The exit code of what was made ("picture") and written. If something was left out that is no
/// success, unless --lenient accepts it; then says so.
int code_for(const Read& read, const Loading& loading, const char* made);

/// --imgsize; `set` is told width and height.
void add_size_option(OptionGroup& group, const std::function<void(int, int)>& set);

/// --imgsize, --camera and what belongs to them.
void add_view_options(CLI::App& app, ViewOptions& view);
/// The same; openscad is told of the camera.
void add_view_options(CLI::App& app, ViewOptions& view, Loading& loading);

/// --colorscheme and --light.
void add_color_options(CLI::App& app, ShadeSettings& shading);

/// --shadows.
void add_shadow_option(CLI::App& app, ShadeSettings& shading);

/// --style alone.
void add_style_option(CLI::App& app, Style& style);
/// --style; --quality and --no-ground, which are of style studio.
void add_style_options(CLI::App& app, ShadeSettings& shading);

/// --backend, --device, --threads and the like. OpenSCAD's own backends stand for `auto`: the
/// picture is the same. Files are read on as many threads.
void add_machine_options(CLI::App& app, RendererSettings& settings, Loading& loading);

/// If a device is named, `auto` becomes the backend that has devices. Fails if another backend was
/// chosen. To be called when the command line has been read.
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
/// Applies --paper first, and then the options that were given one by one.
void apply(const SubdivisionArguments& arguments, RendererSettings& settings);

}  // namespace whittle

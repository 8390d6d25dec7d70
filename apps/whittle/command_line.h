// The options that commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/shade.h"
#include "io/read.h"
#include "limits.h"
#include "option_group.h"
#include "trace/view.h"
#include "whittle/renderer.h"

namespace whittle {

struct Loading {
  Curves curves = Curves::kAuto;
  bool polish = true;
  ReadLimits limits;
  std::optional<std::string> import_root;
  bool strict = false;
  bool quiet = false;
};
void add_loading_options(CLI::App& app, Loading& loading);
/// What equals OpenSCAD's picture has OpenSCAD's facets, unless true curves were chosen.
void suit_style(Style style, Loading& loading);
ReadOptions read_options(const Loading& loading);
/// Says the warnings; or with `strict` and anything that is not supported, the error for that.
Status say_warnings(const Read& read, const Loading& loading);
/// Reads a file, shows the progress, and says its warnings.
Result<Read> load(const std::string& file, const Loading& loading);

/// --imgsize, --camera and what belongs to them.
void add_view_options(CLI::App& app, ViewOptions& view);

/// --colorscheme and --light.
void add_color_options(CLI::App& app, ShadeSettings& shading);

/// --shadows.
void add_shadow_option(CLI::App& app, ShadeSettings& shading);

/// Options of OpenSCAD's that are taken without effect.
struct WithoutEffect {
  std::vector<std::string> missed;  ///< those given that a user may wonder about
  std::vector<std::string> values;  ///< of those that nobody misses
};
void add_openscad_options(CLI::App& app, WithoutEffect& without_effect);
/// Says which were given, if any.
void say_without_effect(const WithoutEffect& without_effect);

/// --backend and --threads. OpenSCAD's own backends stand for `auto`, without effect.
void add_machine_options(CLI::App& app, RendererSettings& settings, WithoutEffect& without_effect);

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

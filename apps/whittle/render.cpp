// whittle FILE -o OUT: makes pictures of a model.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/timing.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "model/instances.h"
#include "option_group.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle", "Exact pictures of Constructive Solid Geometry, from OpenSCAD files.",
    "FILE -o OUT [options]      makes a picture (the default command)\n"
    "       whittle info FILE                  says what is in a file\n"
    "       whittle cells FILE -o OUT.png      draws the cells over the model\n"
    "       whittle compare A.exr B.exr        compares the facts of two pictures\n"
    "       whittle bench FILE...              measures every stage\n"
    "       whittle model NAME [N] [-o OUT]    writes a model made to measure\n"
    "       whittle devices                    lists Vulkan's devices\n\n"
    "FILE is .csg, or .scad if openscad is installed; '-' is standard input. Each\n"
    "command has its own --help. A file that is called like a command is ./info.",
    "Examples:\n"
    "  whittle part.csg -o part.png\n"
    "  whittle part.csg -o part.png -o facts.exr --imgsize 1920,1080\n"
    "  whittle part.csg -o top.png --camera 0,0,0,0,0,0,200 --projection ortho\n"
    "  openscad -o - --export-format csg part.scad | whittle - -o part.png\n\n"
    "Exit codes: 0 done, 1 bad input, 2 bad usage, 3 refused by the machine (device,\n"
    "memory, disk).\n\n"
    "OpenSCAD's -D, -d, -m, -p, -P, --animate, --animate_sharding, --check-parameters,\n"
    "--check-parameter-ranges, --csglimit, --debug, --enable, --hardwarnings, --preview,\n"
    "--render, --summary, --summary-file and --view are taken without effect."};

struct Output {
  std::string path;
  FileFormat format;
};

struct RenderArguments {
  std::string file;
  std::vector<std::string> outputs;
  std::optional<FileFormat> export_format;
  Loading loading;
  ViewOptions view;
  ShadeSettings shading;
  Pass pass = Pass::kColor;
  bool no_background = false;
  int antialias = 0;  ///< 0: what suits the style
  RendererSettings renderer;
  SubdivisionArguments subdivision;
  WithoutEffect without_effect;
  bool wants_statistics = false;
};

void add_options(CommandLine& line, RenderArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.file);
  OptionGroup output(app, "Output"), look(app, "Look"), machine(app, "Machine");
  output.add_each("-o", "OUT", "a .png or .exr, and -o again for more; '-': standard output",
                  [&](const std::string& path) { a.outputs.push_back(path); });
  output.add_choice("--export-format", format_choices(), "format", "{}, whatever OUT ends in",
                    [&](FileFormat format) { a.export_format = format; });
  output.add_choice("--pass", pass_choices(), "pass", "what a PNG shows: {}",
                    [&](Pass pass) { a.pass = pass; });
  add_view_options(app, a.view);
  look.add_choice("--style", style_choices(), "style", "{}",
                  [&](Style style) { a.shading.style = style; });
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  look.add_count("--aa", "N", a.antialias, 1, kMostAntialias,
                 "N x N rays a pixel at edges, 1 to 16 (studio: 4)");
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(app, a.loading);
  add_machine_options(app, a.renderer, a.without_effect);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
  add_openscad_options(app, a.without_effect);
  line.add_version("whittle " WHITTLE_VERSION);
}

Result<std::vector<Output>> choose_outputs(const RenderArguments& a) {
  if (a.outputs.empty()) {
    return Error{ErrorKind::kUsage,
                 "there is no window yet; give -o FILE.png or -o FILE.exr to make a picture"};
  }
  std::vector<Output> outputs;
  for (const std::string& path : a.outputs) {
    Output output{path, FileFormat::kPng};
    const auto is_standard = [](const Output& other) { return other.path == "-"; };
    if (path == "-" && std::ranges::any_of(outputs, is_standard)) {
      return Error{ErrorKind::kUsage, "-o - (standard output) is given more than once"};
    }
    if (a.export_format) {
      output.format = *a.export_format;
    } else if (path == "-") {
      return Error{ErrorKind::kUsage, fmt::format("-o - (standard output) needs --export-format {}",
                                                  names_of(format_choices(), " or "))};
    } else {
      const Result<FileFormat> format = format_of(path);
      if (!format) return format.error();
      output.format = *format;
    }
    outputs.push_back(std::move(output));
  }
  return outputs;
}

Status write_all(const RenderArguments& a, const std::vector<Output>& outputs, const Frame& frame,
                 const Picture& picture) {
  for (const Output& output : outputs) {
    const bool shows_pass = output.format == FileFormat::kPng && a.pass != Pass::kColor;
    const Result<std::string> bytes = encode(
        output.format, frame, shows_pass ? pass_picture(frame, a.pass, !a.no_background) : picture,
        a.no_background, output.path);
    if (!bytes) return bytes.error();
    if (Status written = write_output(output.path, *bytes); !written) return written;
  }
  return Done{};
}

/// Traces and shades; pictures that no output shows are not made.
Status draw(const RenderArguments& a, const std::vector<Output>& outputs, const Camera& camera,
            Renderer& renderer, Frame& frame, Picture& picture) {
  ProgressLine progress(!a.loading.quiet, "subdividing");
  if (Status prepared = renderer.prepare(camera); !prepared) return prepared;
  progress.stage("tracing");
  Result<Frame> traced = renderer.trace(camera, progress.share());
  if (!traced) return traced.error();
  frame = *std::move(traced);
  const bool shows_color =
      a.pass == Pass::kColor || std::ranges::any_of(outputs, [](const Output& output) {
        return output.format == FileFormat::kExr;
      });
  if (!shows_color) return Done{};
  progress.stage("shading");
  const int rays = a.antialias > 0 ? a.antialias : default_antialias(a.shading.style);
  Result<Picture> shaded = renderer.shade(frame, camera, a.shading, rays);
  if (!shaded) return shaded.error();
  picture = *std::move(shaded);
  return Done{};
}

Status render(RenderArguments& a) {
  const Stopwatch watch;
  const Result<std::vector<Output>> outputs = choose_outputs(a);
  if (!outputs) return outputs.error();
  if (Status possible = check_shadows(a.shading); !possible) return possible;
  if (Status possible = settle_device(a.renderer); !possible) return possible;
  for (const Output& output : *outputs) {
    if (Status possible = check_not_input(output.path, a.file); !possible) return possible;
    if (Status possible = check_writable(output.path); !possible) return possible;
  }
  if (!a.loading.quiet) say_without_effect(a.without_effect);

  suit_style(a.shading.style, a.loading);
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  const Model& model = read->model;
  if (bounds(model).box.is_empty() && !a.loading.quiet) {
    say(fmt::format("{}: warning: the solid is empty", model.file));
  }
  RunTimes times{.read = watch.milliseconds()};

  apply(a.subdivision, a.renderer);
  a.shading.background = !a.no_background;
  Result<Renderer> renderer = Renderer::make(model, a.renderer);
  if (!renderer) return renderer.error();
  const Camera camera = renderer->camera(a.view);
  Frame frame;
  Picture picture;
  if (Status drawn = draw(a, *outputs, camera, *renderer, frame, picture); !drawn) return drawn;

  const Stopwatch writing;
  if (Status written = write_all(a, *outputs, frame, picture); !written) return written;
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  if (a.wants_statistics) {
    say_lines(statistics(model, *renderer, a.renderer.backend == Backend::kAuto, times));
  }
  return Done{};
}

}  // namespace

int render_command(Arguments arguments) {
  CommandLine line(kHelp);
  RenderArguments a;
  add_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Status done = render(a);
  return done ? kExitDone : report(done.error());
}

}  // namespace whittle

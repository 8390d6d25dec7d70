// whittle FILE -o OUT: makes pictures of a model.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/timing.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "frame_reader.h"
#include "host/dependencies.h"
#include "host/input_kinds.h"
#include "line_files.h"
#include "openscad_options.h"
#include "option_group.h"
#include "progress.h"
#include "solid_files.h"
#include "statistics.h"
#include "summary.h"
#include "whittle/line_output.h"
#include "whittle/output.h"
#include "whittle/reading.h"

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
    "FILE is .csg, or .scad if openscad is installed, or what import() reads (.stl,\n"
    ".off, .obj, .3mf, .amf, .svg, .dxf); '-' is standard input, as .csg. Each command\n"
    "has its own --help. A file that is called like a command is ./info.",
    "Examples:\n"
    "  whittle part.csg -o part.png\n"
    "  whittle part.csg -o part.png -o facts.exr --imgsize 1920,1080\n"
    "  whittle part.csg -o top.png --camera 0,0,0,0,0,0,200 --projection ortho\n"
    "  whittle part.csg -o part.stl\n"
    "  whittle part.csg -o part.svg --projection ortho --hidden-lines\n"
    "  openscad -o - --export-format csg part.scad | whittle - -o part.png\n\n"
    "  whittle part.scad -o lid.png -D 'part=\"lid\"'\n\n"
    "Exit codes: 0 done, 1 bad input, or something in it is not shown (--lenient: 0),\n"
    "2 bad usage, 3 refused by the machine (device, memory, disk).\n\n"
    "OpenSCAD's --render and --preview decide $preview of a .scad. --backend Manifold or\n"
    "CGAL, --csglimit, --debug, --check-parameters and --check-parameter-ranges change\n"
    "no picture. Other views (--view, --preview=throwntogether) are refused."};

constexpr double kLeastScale = 1e-6, kMostScale = 1e6;

struct Output {
  std::string path;
  FileFormat format;                 ///< of a picture
  std::optional<SolidFormat> solid;  ///< it is none
  bool is_lines = false;             ///< it is a line drawing
};

struct RenderArguments {
  std::string file;
  std::vector<std::string> outputs;
  std::optional<FileFormat> export_format;
  std::optional<SolidFormat> export_solid;
  bool export_lines = false;
  LineSettings lines;
  std::optional<double> scale;
  Loading loading;
  ViewOptions view;
  ShadeSettings shading;
  Pass pass = Pass::kColor;
  bool no_background = false;
  int antialias = 0;  ///< 0: what suits the style
  RendererSettings renderer;
  SubdivisionArguments subdivision;
  OpenscadArguments openscad;
  SummaryArguments summary;
  bool wants_statistics = false;
};

void add_options(CommandLine& line, RenderArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.file);
  OptionGroup output(app, "Output"), look(app, "Look"), machine(app, "Machine");
  output.add_each("-o", "OUT",
                  "a .png, .exr, .svg, .stl, .off or .obj, each -o one;\n'-': standard output",
                  [&](const std::string& path) { a.outputs.push_back(path); });
  output.add_text(
      "--export-format", "NAME",
      names_of(format_choices()) + ", svg, " + names_of(solid_format_choices()) +
          ",\nwhatever OUT ends in",
      [&](const std::string& name) {
        a.export_format.reset();
        a.export_solid.reset();
        a.export_lines = name == "svg";
        if (a.export_lines) return;
        if (const Result<SolidFormat> solid = choose(solid_format_choices(), "format", name)) {
          a.export_solid = *solid;
          return;
        }
        const Result<FileFormat> format = choose(format_choices(), "format", name);
        if (!format) {
          refuse("--export-format", refusal_of_format(name).value_or(format.error().message));
        }
        a.export_format = *format;
      });
  output.add_choice("--pass", pass_choices(), "pass", "what a PNG shows: {}",
                    [&](Pass pass) { a.pass = pass; });
  output.add_flag("--hidden-lines", a.lines.hidden, "an .svg shows hidden lines, dashed");
  output.add_text(
      "--scale", "S", "of an .svg with --projection ortho: millimetres for one unit (1)",
      [&](const std::string& text) {
        a.scale = parse_number("--scale", text);
        if (*a.scale < kLeastScale || *a.scale > kMostScale)
          refuse("--scale",
                 fmt::format("'{}' is not between {} and {}", text, kLeastScale, kMostScale));
      });
  add_openscad_options(line, a.openscad);
  add_summary_options(app, a.summary);
  add_view_options(app, a.view, a.loading);
  look.add_choice("--style", style_choices(), "style", "{}",
                  [&](Style style) { a.shading.style = style; });
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  look.add_count("--aa", "N", a.antialias, 1, kMostAntialias,
                 "N x N rays a pixel at edges, 1 to 16 (studio: 4)");
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
  line.add_version("whittle " WHITTLE_VERSION);
}

Result<std::vector<Output>> choose_outputs(const RenderArguments& a) {
  if (a.outputs.empty()) {
    return Error{ErrorKind::kUsage,
                 "there is no window yet; give -o FILE.png or -o FILE.exr to make a picture"};
  }
  std::vector<Output> outputs;
  for (const std::string& path : a.outputs) {
    Output output{path, FileFormat::kPng, a.export_solid, a.export_lines};
    const auto is_standard = [](const Output& other) { return other.path == "-"; };
    if (path == "-" && std::ranges::any_of(outputs, is_standard)) {
      return Error{ErrorKind::kUsage, "-o - (standard output) is given more than once"};
    }
    if (a.export_format) {
      output.format = *a.export_format;
    } else if (a.export_solid) {
      output.solid = a.export_solid;
    } else if (a.export_lines) {
      output.is_lines = true;
    } else if (is_line_drawing(path)) {
      output.is_lines = true;
    } else if (const std::optional<SolidFormat> solid = solid_format_of(path)) {
      output.solid = solid;
    } else if (path == "-") {
      return Error{ErrorKind::kUsage,
                   fmt::format("-o - (standard output) needs --export-format {}, svg, {}",
                               names_of(format_choices()), names_of(solid_format_choices()))};
    } else {
      const Result<FileFormat> format = format_of(path);
      if (!format) {
        const std::optional<std::string> refusal = refusal_of_format(path);
        return Error{ErrorKind::kUsage,
                     refusal.value_or(fmt::format("'{}' does not end in .png, .exr, .svg, .stl, "
                                                  ".off or .obj, so its format is not known",
                                                  path))};
      }
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
        a.no_background, output.path, a.renderer.threads);
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
  Result<Frame> traced = renderer.trace(camera, {.progress = progress.share()});
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

/// Fails for what can not be done, before it has begun.
Status check_possible(const RenderArguments& a, const std::vector<Output>& outputs) {
  if (Status possible = check_shadows(a.shading); !possible) return possible;
  if (Status possible = check_view(a.view); !possible) return possible;
  if (Status possible = check_loading(a.file, a.loading); !possible) return possible;
  if (a.scale && !a.view.orthographic)
    return Error{ErrorKind::kUsage, "--scale is for --projection ortho; no other view has a scale"};
  const Animation& animation = a.openscad.animation;
  if (animation.shards > 1 && animation.frames == 0) {
    return Error{ErrorKind::kUsage, "--animate_sharding is for --animate N"};
  }
  if (animation.frames > 0 && kind_of_input(a.file) != InputKind::kScad) {
    return Error{ErrorKind::kUsage,
                 fmt::format("--animate: {} has no time; only a .scad file has", a.file)};
  }
  std::vector<std::string> paths;
  for (const Output& output : outputs) {
    if (animation.frames > 0 && (output.solid || output.is_lines)) {
      return Error{ErrorKind::kUsage, "--animate makes pictures, .png or .exr"};
    }
    if (animation.frames > 0 && output.path == "-") {
      return Error{ErrorKind::kUsage, "--animate makes many files; -o - is one"};
    }
    paths.push_back(animation.frames > 0 ? frame_path(output.path, animation.first())
                                         : output.path);
  }
  if (a.openscad.dependency_file) paths.push_back(*a.openscad.dependency_file);
  if (a.summary.file) paths.push_back(*a.summary.file);
  for (const std::string& path : paths) {
    if (Status possible = check_not_input(path, a.file); !possible) return possible;
    if (Status possible = check_writable(path); !possible) return possible;
  }
  return Done{};
}

Status tell_summary(const RenderArguments& a, const Model& model, const GimbalView& view,
                    double milliseconds) {
  if (!a.summary.is_wanted()) return Done{};
  const SummaryFacts facts{view, tight_box(model), milliseconds};
  if (!a.summary.parts.empty() && !a.loading.quiet) {
    if (const std::string lines = summary_lines(facts, a.summary); !lines.empty()) say_lines(lines);
  }
  return a.summary.file ? write_output(*a.summary.file, summary_json(facts, a.summary)) : Done{};
}

/// One picture, from what was read to the files that show it.
Status render(RenderArguments& a, const std::vector<Output>& outputs, const Model& model,
              const Stopwatch& watch) {
  RunTimes times{.read = watch.milliseconds()};
  Result<Renderer> renderer = Renderer::make(model, a.renderer);
  if (!renderer) return renderer.error();
  GimbalView view;
  const Camera camera = renderer->camera(a.view, &view);
  Frame frame;
  Picture picture;
  if (Status drawn = draw(a, outputs, camera, *renderer, frame, picture); !drawn) return drawn;
  say_if_nothing_is_seen(model, frame, a.loading);

  const Stopwatch writing;
  if (Status written = write_all(a, outputs, frame, picture); !written) return written;
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  if (a.wants_statistics) {
    say_lines(statistics(model, *renderer, a.renderer.backend == Backend::kAuto, times));
  }
  return tell_summary(a, model, view, times.total);
}

/// What a run has made so far.
struct Made {
  int code = kExitDone;
  std::vector<std::string> targets, files;  ///< for make

  void add(const std::vector<Output>& outputs, const Read& read) {
    for (const Output& output : outputs) targets.push_back(output.path);
    for (const std::string& file : read.files) {
      if (std::ranges::find(files, file) == files.end()) files.push_back(file);
    }
  }
};

/// Files of the solid; what is read has facets.
Status write_solids(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  Loading loading = a.loading;
  loading.curves = curves_of_solid(loading.curves);
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  std::vector<SolidOutput> files;
  for (const Output& output : outputs) files.push_back({output.path, *output.solid});
  if (Status done = write_solid_files(read->model, files,
                                      {a.renderer.threads, a.loading.quiet, a.wants_statistics});
      !done) {
    return done;
  }
  made.add(outputs, *read);
  made.code = code_for(*read, loading);
  return Done{};
}

/// Line drawings of what was read.
Status draw_lines_of(const RenderArguments& a, const std::vector<Output>& outputs,
                     const Model& model) {
  std::vector<std::string> paths;
  for (const Output& output : outputs) paths.push_back(output.path);
  LineSettings lines = a.lines;
  lines.scale = a.scale.value_or(1);
  return write_line_files(model, paths,
                          {a.view, lines, a.renderer.threads, a.loading.quiet, a.wants_statistics});
}

Status render_still(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  std::vector<Output> pictures, lines, solids;
  for (const Output& output : outputs)
    (output.solid ? solids : output.is_lines ? lines : pictures).push_back(output);
  if (!solids.empty()) {
    if (Status done = write_solids(a, solids, made); !done) return done;
  }
  if (pictures.empty() && lines.empty()) return Done{};
  const Stopwatch watch;
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  if (!lines.empty()) {
    if (Status done = draw_lines_of(a, lines, read->model); !done) return done;
    made.add(lines, *read);
  }
  if (!pictures.empty()) {
    if (Status done = render(a, pictures, read->model, watch); !done) return done;
    made.add(pictures, *read);
  }
  if (made.code == kExitDone) made.code = code_for(*read, a.loading);
  return Done{};
}

Status render_frames(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  const Animation& animation = a.openscad.animation;
  std::vector<double> times;
  for (int i = animation.first(); i < animation.last(); ++i) {
    times.push_back(double(i) / animation.frames);
  }
  FrameReader reader(a.file, read_options(a.loading), times);
  std::set<std::string> said;
  for (size_t i = 0; i < times.size(); ++i) {
    const Stopwatch watch;
    Result<Read> read = reader.next();
    if (!read) {
      return Error{read.error().kind, fmt::format("{} ($t = {})", read.error().message, times[i])};
    }
    // Each warning once.
    std::erase_if(read->warnings,
                  [&](const std::string& warning) { return !said.insert(warning).second; });
    if (Status fit = say_warnings(*read, a.loading); !fit) return fit;
    std::vector<Output> frame = outputs;
    for (Output& output : frame) {
      output.path = frame_path(output.path, animation.first() + int(i));
    }
    if (Status done = render(a, frame, read->model, watch); !done) return done;
    made.add(frame, *read);
    if (made.code == kExitDone) made.code = code_for(*read, a.loading);
  }
  return Done{};
}

Result<int> run(RenderArguments& a) {
  const Result<std::vector<Output>> outputs = choose_outputs(a);
  if (!outputs) return outputs.error();
  if (Status possible = settle_device(a.renderer); !possible) return possible.error();
  if (Status possible = check_possible(a, *outputs); !possible) return possible.error();
  suit_style(a.shading.style, a.loading);
  apply(a.subdivision, a.renderer);
  a.shading.background = !a.no_background;
  Made made;
  const bool moves = a.openscad.animation.frames > 0;
  Status done = moves ? render_frames(a, *outputs, made) : render_still(a, *outputs, made);
  if (done && a.openscad.dependency_file) {
    done = write_output(*a.openscad.dependency_file, write_dependencies(made.targets, made.files));
  }
  if (!done) return done.error();
  return made.code;
}

}  // namespace

int render_command(Arguments arguments) {
  CommandLine line(kHelp);
  RenderArguments a;
  add_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Result<int> code = run(a);
  return code ? *code : report(code.error());
}

}  // namespace whittle

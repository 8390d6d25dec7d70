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
#include "many_files.h"
#include "openscad_options.h"
#include "option_group.h"
#include "output_template.h"
#include "progress.h"
#include "reference.h"
#include "shape_files.h"
#include "statistics.h"
#include "summary.h"
#include "whittle/export_format.h"
#include "whittle/output.h"
#include "whittle/reading.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle", "Exact pictures of Constructive Solid Geometry, from OpenSCAD files.",
    "FILE -o OUT [options]      makes a picture, or a file to print or cut (the default)\n"
    "       whittle FILE... -o '{name}.png'    draws many files, several at a time\n"
    "       whittle info FILE                  says what is in a file\n"
    "       whittle pick FILE --at X,Y         says what is seen at a place\n"
    "       whittle measure FILE --at X,Y ...  measures where one points\n"
    "       whittle cast FILE X,Y,Z DX,DY,DZ   says what rays meet\n"
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
    "  whittle *.csg -o 'pictures/{name}.png'\n"
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
  ExportFormat format;

  bool is_picture() const { return std::holds_alternative<FileFormat>(format); }
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
  int antialias = 0;  ///< 0: what suits the style
  RendererSettings renderer;
  SubdivisionArguments subdivision;
  OpenscadArguments openscad;
  SummaryArguments summary;
  ReferenceArguments reference;
  bool wants_statistics = false;
};

void add_options(CommandLine& line, RenderArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.files);
  OptionGroup output(app, "Output"), look(app, "Look"), machine(app, "Machine");
  output.add_each("-o", "OUT",
                  "a picture (.png, .exr), the solid (.stl, .off, .obj, .3mf, .amf)\n"
                  "or a drawing (.svg, .dxf; of a solid an .svg, in lines), each -o\n"
                  "one; '-': standard output; {name} in it is FILE's name",
                  [&](const std::string& path) { a.outputs.push_back(path); });
  output.add_text(
      "--export-format", "NAME", names_of(export_format_choices()) + ",\nwhatever OUT ends in",
      [&](const std::string& name) {
        const Result<ExportFormat> format = choose(export_format_choices(), "format", name);
        if (!format)
          refuse("--export-format", refusal_of_format(name).value_or(format.error().message));
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
  add_reference_options(app, a.reference);
  add_view_options(app, a.view, a.loading);
  add_style_options(app, a.shading);
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  look.add_count("--aa", "N", a.antialias, 1, kMostAntialias,
                 "N x N rays a pixel at edges, 1 to 16 (studio: 3, plain: 4)");
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
  line.add_version("whittle " WHITTLE_VERSION);
}

Result<std::vector<Output>> choose_outputs(const RenderArguments& a) {
  if (a.outputs.empty() && !a.reference.file) {
    return Error{ErrorKind::kUsage,
                 "there is no window yet; give -o FILE, which may end in " + export_endings()};
  }
  std::vector<Output> outputs;
  for (const std::string& path : a.outputs) {
    const auto is_standard = [](const Output& other) { return other.path == "-"; };
    if (path == "-" && std::ranges::any_of(outputs, is_standard)) {
      return Error{ErrorKind::kUsage, "-o - (standard output) is given more than once"};
    }
    if (a.export_format) {
      outputs.push_back({path, *a.export_format});
      continue;
    }
    if (path == "-") {
      return Error{ErrorKind::kUsage, fmt::format("-o - (standard output) needs --export-format {}",
                                                  names_of(export_format_choices()))};
    }
    const Result<ExportFormat> format = export_format_of(path);
    if (!format) {
      return Error{ErrorKind::kUsage, refusal_of_format(path).value_or(format.error().message)};
    }
    outputs.push_back({path, *format});
  }
  return outputs;
}

/// What a PNG shows.
Picture shown(const RenderArguments& a, const Frame& frame, const Picture& picture) {
  return a.pass == Pass::kColor ? picture : pass_picture(frame, a.pass, !a.no_background);
}

Status write_all(const RenderArguments& a, const std::vector<Output>& outputs, const Frame& frame,
                 const Picture& picture) {
  for (const Output& output : outputs) {
    const Result<std::string> bytes =
        encode(std::get<FileFormat>(output.format), frame,
               output.is(FileFormat::kPng) ? shown(a, frame, picture) : picture, a.no_background,
               output.path, a.renderer.threads);
    if (!bytes) return bytes.error();
    if (Status written = write_output(output.path, *bytes); !written) return written;
  }
  return Done{};
}

Status compare_if_asked(const RenderArguments& a, const Frame& frame, const Picture& picture) {
  if (!a.reference.file) return Done{};
  return compare_with_reference(a.reference, a.file, frame,
                                a.reference.wants_picture() ? shown(a, frame, picture) : Picture(),
                                a.no_background);
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
        return output.is(FileFormat::kExr);
      });
  if (!shows_color) return Done{};
  progress.stage("shading");
  const int rays =
      a.antialias > 0 ? a.antialias : default_antialias(a.shading.style, a.shading.quality);
  Result<Picture> shaded = renderer.shade(frame, camera, a.shading, rays);
  if (!shaded) return shaded.error();
  picture = *std::move(shaded);
  return Done{};
}

/// Where an output of a frame goes. Precondition: check_templates() found no mistake.
std::string frame_output(const RenderArguments& a, const std::string& pattern, int frame) {
  const std::string path =
      *fill_template(pattern, {template_name(a.file), fmt::format("{:05}", frame)});
  return has_word(pattern, "n") ? path : frame_path(path, frame);
}

/// Fails for what can not be done, before it has begun.
Status check_possible(const RenderArguments& a, const std::vector<Output>& outputs) {
  if (Status possible = check_shadows(a.shading); !possible) return possible;
  if (Status possible = check_view(a.view); !possible) return possible;
  if (Status possible = check_loading(a.file, a.loading); !possible) return possible;
  if (Status possible = check_reference(a.reference); !possible) return possible;
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
  if (animation.frames > 0 && a.reference.file) {
    return Error{ErrorKind::kUsage, "--reference is for one picture, and --animate makes many"};
  }
  std::vector<std::string> paths;
  for (const Output& output : outputs) {
    if (animation.frames > 0 && !output.is_picture()) {
      return Error{ErrorKind::kUsage, "--animate makes pictures, .png or .exr"};
    }
    if (animation.frames > 0 && output.path == "-") {
      return Error{ErrorKind::kUsage, "--animate makes many files; -o - is one"};
    }
    paths.push_back(animation.frames > 0 ? frame_output(a, output.path, animation.first())
                                         : output.path);
  }
  if (a.openscad.dependency_file) paths.push_back(*a.openscad.dependency_file);
  if (a.summary.file) paths.push_back(*a.summary.file);
  if (a.reference.difference) paths.push_back(*a.reference.difference);
  for (const std::string& path : paths) {
    if (Status possible = check_not_input(path, a.file); !possible) return possible;
    if (a.reference.file) {
      if (Status possible = check_not_input(path, *a.reference.file); !possible) return possible;
    }
    if (Status possible = check_writable(path); !possible) return possible;
  }
  return Done{};
}

Status tell_summary(const RenderArguments& a, const SummaryFacts& facts) {
  if (!a.summary.parts.empty() && !a.loading.quiet) {
    if (const std::string lines = summary_lines(facts, a.summary); !lines.empty()) say_lines(lines);
  }
  return a.summary.file ? write_output(*a.summary.file, summary_json(facts, a.summary)) : Done{};
}

/// One picture, from what was read to the files that show it. What a summary says of it goes to
/// `facts`.
Status render(RenderArguments& a, const std::vector<Output>& outputs, const Model& model,
              const Stopwatch& watch, SummaryFacts& facts) {
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
  if (a.summary.is_wanted())
    facts = {view, {.dimensions = model.drawing ? 2 : 3, .box = tight_box(model)}, times.total};
  return compare_if_asked(a, frame, picture);
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

/// The view that a picture would have, where nothing but the box is known.
GimbalView view_of_box(const RenderArguments& a, const Model& model, const Box& box) {
  const auto reach = [&](const Directions& directions) { return box_reach(box, directions); };
  return frame_view(a.view, model.view, box, reach).view;
}

/// Line drawings of a solid, as its pictures show it; its warnings were said. Adds to what a
/// summary says, which has its geometry and view already if there are files of another kind.
Status write_lines(RenderArguments& a, const std::vector<Output>& outputs, bool is_alone,
                   Made& made, SummaryFacts& facts) {
  const Stopwatch watch;
  Loading loading = a.loading;
  loading.quiet = true;
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  std::vector<std::string> paths;
  for (const Output& output : outputs) paths.push_back(output.path);
  LineSettings lines = a.lines;
  lines.scale = a.scale.value_or(1);
  const Status drawn = write_line_files(
      read->model, paths, {a.view, lines, a.renderer.threads, a.loading.quiet, a.wants_statistics});
  if (!drawn) return drawn;
  made.add(outputs, *read);
  if (made.code == kExitDone) made.code = code_for(*read, loading, "drawing");
  facts.milliseconds += watch.milliseconds();
  if (is_alone) {
    facts.geometry = {.box = tight_box(read->model)};
    facts.view = view_of_box(a, read->model, facts.geometry.box);
  }
  return Done{};
}

/// Files of the shape; what is read has facets. Adds to what a summary says of pictures.
Status write_shapes(RenderArguments& a, const std::vector<Output>& outputs, bool has_pictures,
                    Made& made, SummaryFacts& facts) {
  const Stopwatch watch;
  Loading loading = a.loading;
  loading.curves = curves_of_shape(loading.curves);
  loading.outlines = true;
  loading.quiet = loading.quiet || has_pictures;  // warnings were said
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  // An .svg is of the view if there is one.
  std::vector<Output> shapes, lines;
  for (const Output& output : outputs) {
    const bool is_svg = output.format == ExportFormat(DrawingFormat::kSvg);
    (is_svg && !read->model.drawing ? lines : shapes).push_back(output);
  }
  if (!shapes.empty()) {
    std::vector<ShapeOutput> files;
    for (const Output& output : shapes) files.push_back({output.path, output.format});
    const Result<GeometryFacts> geometry = write_shape_files(
        read->model, files,
        {a.loading.curves, a.renderer.threads, a.loading.quiet, a.wants_statistics});
    if (!geometry) return geometry.error();
    made.add(shapes, *read);
    if (made.code == kExitDone)
      made.code = code_for(*read, loading, read->model.drawing ? "drawing" : "solid");
    facts.geometry = *geometry;
    if (!has_pictures) facts.view = view_of_box(a, read->model, geometry->box);
  }
  facts.milliseconds += watch.milliseconds();
  if (lines.empty()) return Done{};
  return write_lines(a, lines, !has_pictures && shapes.empty(), made, facts);
}

/// Pictures first: what is no solid to print may well be seen.
Status render_still(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  std::vector<Output> pictures, shapes;
  for (const Output& output : outputs) (output.is_picture() ? pictures : shapes).push_back(output);
  // What has facets is read on its own.
  if (!shapes.empty()) a.loading.standard_input = std::make_shared<std::optional<std::string>>();
  SummaryFacts facts;
  if (!pictures.empty() || a.reference.file) {
    const Stopwatch watch;
    const Result<Read> read = load(a.file, a.loading);
    if (!read) return read.error();
    if (Status done = render(a, pictures, read->model, watch, facts); !done) return done;
    made.add(pictures, *read);
    made.code = code_for(*read, a.loading, "picture");
  }
  if (!shapes.empty()) {
    if (Status done = write_shapes(a, shapes, !pictures.empty(), made, facts); !done) return done;
  }
  return a.summary.is_wanted() ? tell_summary(a, facts) : Done{};
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
      output.path = frame_output(a, output.path, animation.first() + int(i));
    }
    SummaryFacts facts;
    if (Status done = render(a, frame, read->model, watch, facts); !done) return done;
    if (a.summary.is_wanted()) {
      if (Status done = tell_summary(a, facts); !done) return done;
    }
    made.add(frame, *read);
    if (made.code == kExitDone) made.code = code_for(*read, a.loading, "picture");
  }
  return Done{};
}

/// All outputs, as templates.
std::vector<OutputTemplate> templates_of(const RenderArguments& a,
                                         const std::vector<Output>& outputs) {
  std::vector<OutputTemplate> templates;
  for (const Output& output : outputs) templates.push_back({"-o", output.path, true});
  if (a.openscad.dependency_file) templates.push_back({"-d", *a.openscad.dependency_file, false});
  if (a.summary.file) templates.push_back({"--summary-file", *a.summary.file, false});
  if (a.reference.file) templates.push_back({"--reference", *a.reference.file, false});
  if (a.reference.difference)
    templates.push_back({"--reference-difference", *a.reference.difference, false});
  return templates;
}

/// One file. The outputs are templates.
Result<int> run_one(RenderArguments& a, std::vector<Output> outputs) {
  const bool moves = a.openscad.animation.frames > 0;
  const auto fill = [&](std::string& path) {
    path = *fill_template(path, {template_name(a.file)});
  };
  for (Output& output : outputs)
    if (!moves) fill(output.path);
  if (a.openscad.dependency_file) fill(*a.openscad.dependency_file);
  if (a.summary.file) fill(*a.summary.file);
  if (a.reference.file) fill(*a.reference.file);
  if (a.reference.difference) fill(*a.reference.difference);
  if (Status possible = check_possible(a, outputs); !possible) return possible.error();
  Made made;
  Status done = moves ? render_frames(a, outputs, made) : render_still(a, outputs, made);
  if (done && a.openscad.dependency_file) {
    done = write_output(*a.openscad.dependency_file, write_dependencies(made.targets, made.files));
  }
  if (!done) return done.error();
  return made.code;
}

int run_many(const RenderArguments& all, const std::vector<Output>& outputs) {
  // A device serves one tracer at a time, and to open it for each file takes longer than a file.
  const bool on_device = all.renderer.backend == Backend::kVulkanRaster;
  const ManyFiles many{all.files, all.renderer.threads, on_device, all.loading.quiet};
  const auto draw = [&](size_t file, int threads) {
    RenderArguments a = all;
    a.file = all.files[file];
    if (a.renderer.backend == Backend::kAuto) a.renderer.backend = Backend::kCpu;
    a.renderer.threads = threads;
    a.loading.threads = &a.renderer.threads;
    const Result<int> code = run_one(a, outputs);
    return code ? *code : report(code.error());
  };
  return draw_all(many, draw);
}

Result<int> run(RenderArguments& a) {
  const Result<std::vector<Output>> outputs = choose_outputs(a);
  if (!outputs) return outputs.error();
  if (Status possible = settle_device(a.renderer); !possible) return possible.error();
  const bool moves = a.openscad.animation.frames > 0;
  if (Status possible = check_templates(a.files, templates_of(a, *outputs), moves); !possible)
    return possible.error();
  suit_style(a.shading.style, a.loading);
  a.view.tight = frames_tightly(a.shading.style);
  apply(a.subdivision, a.renderer);
  a.shading.background = !a.no_background;
  if (a.files.size() > 1) return run_many(a, *outputs);
  a.file = a.files[0];
  return run_one(a, *outputs);
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
